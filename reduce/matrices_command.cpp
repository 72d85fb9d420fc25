#include "reduce/matrices_command.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/dense/blas.hpp"
#include "reduce/matrices/reduce_matrices.hpp"
#include "reduce/matrices/verification.hpp"
#include "reduce/output_file.hpp"
#include "reduce/report/summary.hpp"

namespace bielle::reduce {

namespace {

/// A verification takes several factorisations: 105,000 unknowns of solid cells 47 s of processor time and 1.4 GB.
/// Larger sets are verified only on request.
constexpr Eigen::Index most_verified = 150000;

/// Verifies the matrices as they were read. @returns the line of the summary
/// @throws InputError for a mass that is not positive
std::string verified(const MatrixSet& matrices, const CommonOptions& common, Progress& progress) {
  if (matrices.size() > most_verified)
    return fmt::format("{}: not verified, since {} take long; --verify does it\n", matrices.source,
                       counted(matrices.size(), "unknown"));
  progress.start("verification");
  const Verification verification = verify(matrices, common.threads);
  const std::vector<Finding> failures = verification.failures();
  for (const Finding& finding : failures)
    if (finding.check.name == "mass_definiteness")  // all other faults leave a body that can be looked at
      throw InputError(fmt::format("{}: {}", matrices.source, finding.fault));
  for (const Finding& finding : failures) progress.warn(finding.fault);
  return failures.empty()
             ? fmt::format("{}: verified, {} passed\n", matrices.source, counted(verification.checks(), "check"))
             : fmt::format("{}: {} of {} checks fail, see the warnings and --verify\n", matrices.source,
                           failures.size(), verification.checks());
}

}  // namespace

void reduce_matrices_of(const MatrixBody& body, const std::string& output, const CommonOptions& common,
                        Progress& progress) {
  progress.start("reading");
  MatrixSet matrices = about(
      "matrices", [&] { return read_foreign_matrices(body.files, progress); }, Subject::hidden);
  const std::string verdict = verified(matrices, common, progress);
  ReductionReport report;
  const Superelement result = reduce_matrices(matrices, body.options, progress, common.threads, &report);
  progress.start("writing");
  write_superelement(result, output);
  progress.finish();
  if (!common.quiet)
    fmt::print("{}{}{}{}{}", verdict, describe(result), describe(report.checks), describe(report, progress.phases()),
               written(output));
}

void reduce_from(const std::string& path, std::string output, const std::string& units, const CommonOptions& common) {
  if (output.empty()) output = std::filesystem::path(path).replace_extension(".h5").string();
  check_output(output, {path});
  start_blas(common.threads);
  Progress progress(common.quiet);
  MatrixBody body;
  body.files.path = path;
  body.files.units = units;
  reduce_matrices_of(body, output, common, progress);
}

}  // namespace bielle::reduce
