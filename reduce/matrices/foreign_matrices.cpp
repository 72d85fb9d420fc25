#include "reduce/matrices/foreign_matrices.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/foreign_mesh.hpp"

namespace bielle::reduce {

namespace {

/// Returns whether nothing but the file is requested, so that a matrix file needs no conversion.
bool asks_for_the_file_alone(const ForeignMatrices& request) {
  return request.mass.empty() && request.nodes.empty() && request.unknowns.empty() && request.format.empty() &&
         request.names.empty() && request.quantities.empty() && request.units.empty();
}

/// "stiffness=KAAX,mass=MAAX"
std::string names_of(const ForeignMatrices& request) {
  std::vector<std::string> words;
  for (const auto& [matrix, name] : request.names) words.push_back(fmt::format("{}={}", matrix, name));
  return fmt::format("{}", fmt::join(words, ","));
}

/// "gauges=OTM1:stress"
std::string quantities_of(const ForeignMatrices& request) {
  std::vector<std::string> words;
  for (const auto& [name, quantity] : request.quantities)
    words.push_back(fmt::format("{}={}:{}", name, quantity.matrix, quantity.kind));
  return fmt::format("{}", fmt::join(words, ","));
}

}  // namespace

MatrixSet read_foreign_matrices(const ForeignMatrices& request, Progress& progress) {
  if (asks_for_the_file_alone(request) && Hdf5File::begins_like_one(request.path) && holds_matrices(request.path))
    return read_matrix_set(request.path);
  const ScratchFolder folder;
  const std::string target = (folder.path() / "matrices.h5").string();
  std::vector<std::string> arguments = {request.path, target, "--to", "matrices"};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {option, value});
  };
  add("--mass", request.mass);
  add("--nodes", request.nodes);
  add("--unknowns", request.unknowns);
  add("--interfaces", fmt::format("{}", fmt::join(request.interfaces, ",")));
  add("--from", request.format);
  add("--units", request.units);
  add("--names", names_of(request));
  add("--quantities", quantities_of(request));
  add("--asked-by", request.in_body_file ? "keys" : "options");
  for (const std::string& note : run_tool("bielle-exchange", arguments, target, request.path)) progress.note(note);
  return read_matrix_set(target);
}

}  // namespace bielle::reduce
