#include "reduce/mesh/gmsh/assembly.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/mesh/gmsh/gluing.hpp"
#include "reduce/mesh/gmsh/healing.hpp"
#include "reduce/mesh/gmsh/solid_selection.hpp"
#include "reduce/mesh/gmsh/solids.hpp"
#include "reduce/mesh/groups.hpp"

namespace bielle::reduce {

namespace {

// Makes physical volumes of the names of the solids, and of those of parts that the request uses.
void name_solids(const MeshRequest& request, const std::vector<BodySolid>& solids) {
  std::set<std::string> used, names;
  for (const VolumeSelection& volume : request.volumes) used.insert(volume.group);
  used.erase("all");
  const bool regions = !used.empty();
  for (const auto& [name, size] : request.sizes) used.insert(name);
  for (const std::string& name : used)
    if (std::any_of(solids.begin(), solids.end(), [&](const BodySolid& solid) { return solid.is_called(name); }))
      names.insert(name);
  if (names.empty() && !regions) return;
  // The other names are added because they are suggested for wrong ones, unless the only solid has no name.
  for (const BodySolid& solid : solids)
    if (solids.size() > 1 || !solid.path.empty()) names.insert(solid.name());
  for (const std::string& name : names) {
    std::vector<int> volumes;
    for (const BodySolid& solid : solids)
      if (solid.is_called(name)) volumes.insert(volumes.end(), solid.volumes.begin(), solid.volumes.end());
    gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, volumes), name);
  }
}

}  // namespace

std::vector<PhysicalGroup> assemble_solids(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                                           Progress& progress) {
  std::vector<PhysicalGroup> groups;
  session.read(fmt::format("the solids of '{}' cannot be joined", source.name), [&] {
    const bool named = !group_names(physical_groups(), 3).empty();
    std::vector<BodySolid> solids = select_solids(request, source);
    if (request.heal) heal_solids(request, source, solids, progress);
    if (request.glue) glue_solids(request, source, solids, progress);
    if (!named) name_solids(request, solids);
    groups = physical_groups();
    check_one_piece(request, source, solids);
  });
  return groups;
}

}  // namespace bielle::reduce
