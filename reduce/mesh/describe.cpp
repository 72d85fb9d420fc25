#include "reduce/mesh/describe.hpp"

#include "reduce/common/process/child_process.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/gmsh_work.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

std::string describe_geometry(const std::string& path, const std::optional<std::string>& length_unit,
                              Progress& progress, bool system_calls, const std::map<std::string, double>& densities) {
  MeshRequest request;
  request.path = path;
  request.length_unit = length_unit;
  const SourceFile source = prepare_source(request, progress);
  return in_child_process(loss_of(source), {}, [&] {
    const GmshWork& gmsh = gmsh_work();
    if (!system_calls) forbid_system_calls(source);
    return gmsh.describe_source(path, source, densities);
  });
}

}  // namespace bielle::reduce
