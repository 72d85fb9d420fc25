#include "reduce/mesh/gmsh/healing.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/gmsh/fragments.hpp"
#include "reduce/mesh/groups.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

constexpr double share_of_size = 0.01;  // smaller edges and faces are removed

// "36 edges and 16 faces"
std::string edges_and_faces() {
  gmsh::vectorpair edges, faces;
  gmsh::model::getEntities(edges, 1);
  gmsh::model::getEntities(faces, 2);
  return fmt::format("{} and {}", counted(edges.size(), "edge"), counted(faces.size(), "face"));
}

// @throws InputError for geometries that cannot be healed
void check_healable(const MeshRequest& request, const SourceFile& source) {
  if (!is_open_cascade())
    throw InputError(
        request.heal_subject,
        fmt::format("'{}' is a geometry of gmsh's own kernel, which cannot be healed: remove this key", source.name));
  if (!request.size)
    throw InputError(request.heal_subject,
                     "healing removes edges and faces that are small against `size`: give it too");
  if (const auto names = group_names(physical_groups(), 2); !names.empty())
    throw InputError(request.heal_subject, fmt::format("'{}' has physical surfaces ({} ..), which healing would lose: "
                                                       "remove them and select by shape, or remove this key",
                                                       source.name, names.front()));
}

}  // namespace

void heal_solids(const MeshRequest& request, const SourceFile& source, std::vector<BodySolid>& solids,
                 Progress& progress) {
  check_healable(request, source);
  const std::vector<NumberedGroup> groups = numbered_groups();
  const std::string before = edges_and_faces();
  const double tolerance = share_of_size * *request.size;
  gmsh::vectorpair originals;
  Parts healed_of;
  for (BodySolid& solid : solids) {
    const Entity original{3, solid.volumes.front()};
    gmsh::vectorpair healed;
    gmsh::model::occ::healShapes(healed, {original}, tolerance / source.metres);
    std::vector<int> volumes;
    for (const auto& [dimension, tag] : healed)
      if (dimension == 3) volumes.push_back(tag);
    if (volumes.size() != 1)
      throw InputError(request.heal_subject, fmt::format("{} is no solid any more without its details below {}: a "
                                                         "smaller mesh.size leaves more of them, or remove this key",
                                                         solid.label(), length_name(tolerance)));
    originals.push_back(original);
    healed_of[original] = {{3, volumes.front()}};
    solid.volumes = volumes;
  }
  gmsh::model::occ::remove(originals, true);
  gmsh::model::occ::synchronize();
  restore_groups(groups, healed_of);
  progress.note(
      fmt::format("heal: {} became {} without those below {}", before, edges_and_faces(), length_name(tolerance)));
}

}  // namespace bielle::reduce
