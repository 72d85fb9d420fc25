#include "reduce/verify_command.hpp"

#include <vector>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/file_checks.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/matrices/foreign_matrices.hpp"
#include "reduce/matrices/set_comparison.hpp"
#include "reduce/matrices/superelement_set.hpp"
#include "reduce/report/verification_report.hpp"
#include "reduce/superelement/cut_body.hpp"

namespace bielle::reduce {

namespace {

std::vector<MatrixSet> sets_of_superelement(const std::string& path) {
  std::vector<MatrixSet> sets;
  if (!holds_pieces(path)) {
    sets.push_back(matrix_set_of(read_superelement(path)));
    return sets;
  }
  const CutBody body = read_cut_body(path);
  for (const Superelement& piece : body.pieces) sets.push_back(matrix_set_of(piece));
  return sets;
}

/// Returns the sets of a file: one, or one for each piece of a body.
std::vector<MatrixSet> sets_of(const std::string& path, const std::string& units, Progress& progress) {
  check_input_file(path);
  if (Hdf5File::begins_like_one(path) && !holds_matrices(path)) return sets_of_superelement(path);
  ForeignMatrices files;
  files.path = path;
  files.units = units;
  return {read_foreign_matrices(files, progress)};
}

}  // namespace

bool verify_file(const VerifyRequest& request, const CommonOptions& common) {
  start_blas(common.threads);
  Progress progress(common.quiet);
  const std::vector<MatrixSet> sets = sets_of(request.path, request.units, progress);
  std::vector<MatrixSet> others;
  if (request.against) others = sets_of(*request.against, request.units, progress);
  if (request.against && (sets.size() > 1 || others.size() > 1))
    throw InputError("--against compares whole bodies: one of the files holds a body in pieces");
  bool passed = true;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    Verification verification = verify(sets[k], common.threads);
    if (request.against) verification.subjects.push_back(compare(sets[k], others[0], common.threads));
    fmt::print("{}{}{}", k == 0 ? "" : "\n", sets.size() > 1 ? fmt::format("piece {}\n", k + 1) : "",
               describe(verification));
    passed = passed && verification.failures().empty();
  }
  return passed;
}

}  // namespace bielle::reduce
