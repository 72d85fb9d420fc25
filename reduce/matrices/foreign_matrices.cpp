#include "reduce/matrices/foreign_matrices.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/foreign_mesh.hpp"

namespace bielle::reduce {

MatrixSet read_foreign_matrices(const ForeignMatrices& request, Progress& progress) {
  if (request.units.empty() && Hdf5File::begins_like_one(request.path) && holds_matrices(request.path))
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
  std::string names;
  for (const auto& [matrix, name] : request.names)
    names += fmt::format("{}{}={}", names.empty() ? "" : ",", matrix, name);
  add("--names", names);
  for (const std::string& note : run_tool("bielle-exchange", arguments, target, request.path)) progress.note(note);
  return read_matrix_set(target);
}

}  // namespace bielle::reduce
