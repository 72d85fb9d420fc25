#include "reduce/mesh/geometry_surface.hpp"

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/process/child_process.hpp"
#include "reduce/mesh/gmsh_work.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

std::string surface_of_geometry(const std::string& path, const std::optional<std::string>& length_unit,
                                Progress& progress, bool system_calls) {
  MeshRequest request;
  request.path = path;
  request.length_unit = length_unit;
  const SourceFile source = prepare_source(request, progress);
  if (!source.geometry)
    throw InputError(fmt::format("'{}' is a mesh, not a geometry (.step, .brep, .iges, .geo)", path));
  return in_child_process(loss_of(source), {}, [&] {
    const GmshWork& gmsh = gmsh_work();
    if (!system_calls) forbid_system_calls(source);
    return gmsh.surface_of_source(source);
  });
}

}  // namespace bielle::reduce
