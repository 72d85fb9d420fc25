#include "reduce/mesh/import.hpp"

#include <filesystem>

#include "reduce/common/error.hpp"
#include "reduce/common/files/packing.hpp"
#include "reduce/common/process/child_process.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/gmsh_work.hpp"
#include "reduce/mesh/mesh_packing.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

Mesh import_mesh(const MeshRequest& request, Progress& progress) {
  progress.start("reading " + std::filesystem::path(request.path).filename().string());
  const SourceFile source = prepare_source(request, progress);
  Packing result(in_child_process(loss_of(source, request.subject), {}, [&] {
    const GmshWork& gmsh = gmsh_work();
    if (!request.system_calls) about(request.subject, [&] { forbid_system_calls(source); });
    Packing packing;
    Mesh mesh = gmsh.import_source(request, source, progress);
    packing(mesh);
    progress.finish();
    std::vector<PhaseReport> phases = progress.phases();
    packing(phases);
    return packing.bytes();
  }));
  Mesh mesh;
  std::vector<PhaseReport> phases;
  result(mesh);
  result(phases);
  progress.adopt(std::move(phases));
  return mesh;
}

}  // namespace bielle::reduce
