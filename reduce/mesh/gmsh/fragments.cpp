#include "reduce/mesh/gmsh/fragments.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

#include <gmsh.h>

namespace bielle::reduce {

namespace {

// Removes the divided volumes and every face that bounds no volume: those of divided volumes, and the parts of tools
// outside the body.
void remove_leftovers(const Parts& parts_of) {
  gmsh::vectorpair divided;
  for (const auto& [entity, parts] : parts_of)
    if (entity.first == 3 && parts != gmsh::vectorpair{entity}) divided.push_back(entity);
  gmsh::model::occ::remove(divided);
  gmsh::model::occ::synchronize();
  gmsh::vectorpair faces, loose;
  gmsh::model::getEntities(faces, 2);
  for (const Entity& face : faces) {
    std::vector<int> volumes, curves;
    gmsh::model::getAdjacencies(2, face.second, volumes, curves);
    if (volumes.empty()) loose.push_back(face);
  }
  gmsh::model::occ::remove(loose, true);
  gmsh::model::occ::synchronize();
}

}  // namespace

std::vector<NumberedGroup> numbered_groups() {
  std::vector<NumberedGroup> groups;
  for (const int dimension : {2, 3}) {
    gmsh::vectorpair pairs;
    gmsh::model::getPhysicalGroups(pairs, dimension);
    for (const Entity& pair : pairs) {
      NumberedGroup group{pair, {}, {}};
      gmsh::model::getPhysicalName(dimension, pair.second, group.name);
      gmsh::model::getEntitiesForPhysicalGroup(dimension, pair.second, group.entities);
      groups.push_back(group);
    }
  }
  return groups;
}

bool is_open_cascade() {
  gmsh::vectorpair volumes, known;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::occ::getEntities(known, 3);
  const std::set<Entity> solids(known.begin(), known.end());
  return std::all_of(volumes.begin(), volumes.end(), [&](const Entity& volume) { return solids.contains(volume); });
}

Parts divide_volumes(const std::vector<Entity>& tools) {
  gmsh::vectorpair body, result, surfaces;
  gmsh::model::getEntities(body, 3);
  gmsh::model::getEntities(surfaces, 2);
  body.insert(body.end(), surfaces.begin(), surfaces.end());  // surfaces take part, so that their parts are known
                                                              // afterwards
  std::vector<gmsh::vectorpair> parts;
  // gmsh 4.8 returns wrong parts if the same call removes the divided entities.
  gmsh::model::occ::fragment(body, tools, result, parts, -1, false, false);
  gmsh::model::occ::synchronize();
  Parts parts_of;
  for (std::size_t k = 0; k < body.size(); ++k) parts_of[body[k]] = parts[k];
  remove_leftovers(parts_of);
  return parts_of;
}

void restore_groups(const std::vector<NumberedGroup>& groups, const Parts& parts_of) {
  gmsh::model::removePhysicalGroups();
  for (const NumberedGroup& group : groups) {
    const int dimension = group.group.first;
    std::set<int> entities;
    for (const int entity : group.entities)
      if (const auto parts = parts_of.find({dimension, std::abs(entity)}); parts != parts_of.end())
        for (const Entity& part : parts->second)
          if (part.first == dimension) entities.insert(part.second);
    if (entities.empty()) continue;
    gmsh::model::addPhysicalGroup(dimension, {entities.begin(), entities.end()}, group.group.second);
    if (!group.name.empty()) gmsh::model::setPhysicalName(dimension, group.group.second, group.name);
  }
}

}  // namespace bielle::reduce
