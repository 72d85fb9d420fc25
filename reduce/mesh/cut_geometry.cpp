#include "reduce/mesh/cut_geometry.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/progress.hpp"

namespace bielle::reduce {

namespace {

using Entity = std::pair<int, int>;  // dimension, tag

// A physical group with its number in gmsh.
struct NumberedGroup {
  Entity group;
  std::string name;
  std::vector<int> entities;
};

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

// Adds a square in the plane that extends beyond the body on all sides; lengths in the unit of the model.
Entity add_square(const CutPlane& plane, double metres) {
  double low[3], high[3];
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  const Eigen::Map<const Eigen::Vector3d> a(low), b(high);
  const Eigen::Vector3d n = plane.normal, point = plane.point / metres, middle = (a + b) / 2;
  const Eigen::Vector3d centre = middle - n.dot(middle - point) * n;
  const Eigen::Vector3d side = (b - a).norm() * n.unitOrthogonal(), other = n.cross(side);
  std::vector<int> corners, lines;
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Eigen::Vector3d x = centre + u * side + v * other;
    corners.push_back(gmsh::model::occ::addPoint(x.x(), x.y(), x.z()));
  }
  for (std::size_t k = 0; k < 4; ++k) lines.push_back(gmsh::model::occ::addLine(corners[k], corners[(k + 1) % 4]));
  return {2, gmsh::model::occ::addPlaneSurface({gmsh::model::occ::addCurveLoop(lines)})};
}

// Removes the divided volumes and every face that bounds no volume: those of divided volumes, and the parts of the
// squares outside the body.
void remove_leftovers(const std::map<Entity, gmsh::vectorpair>& parts_of) {
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

// Maps the volumes and surfaces before the cuts to their parts.
std::map<Entity, gmsh::vectorpair> divide(const std::vector<CutPlane>& planes, double metres) {
  gmsh::vectorpair body, surfaces, squares, result;
  gmsh::model::getEntities(body, 3);
  gmsh::model::getEntities(surfaces, 2);
  body.insert(body.end(), surfaces.begin(), surfaces.end());  // to learn what becomes of them
  for (const CutPlane& plane : planes) squares.push_back(add_square(plane, metres));
  std::vector<gmsh::vectorpair> parts;
  // gmsh 4.8 returns wrong parts if the same call removes the divided entities.
  gmsh::model::occ::fragment(body, squares, result, parts, -1, false, false);
  gmsh::model::occ::synchronize();
  std::map<Entity, gmsh::vectorpair> parts_of;
  for (std::size_t k = 0; k < body.size(); ++k) parts_of[body[k]] = parts[k];
  remove_leftovers(parts_of);
  return parts_of;
}

void restore_groups(const std::vector<NumberedGroup>& groups, const std::map<Entity, gmsh::vectorpair>& parts_of) {
  gmsh::model::removePhysicalGroups();
  for (const NumberedGroup& group : groups) {
    const int dimension = group.group.first;
    std::set<int> entities;
    for (const int entity : group.entities)
      if (const auto parts = parts_of.find({dimension, std::abs(entity)}); parts != parts_of.end())
        for (const Entity& part : parts->second)
          if (part.first == dimension) entities.insert(part.second);
    gmsh::model::addPhysicalGroup(dimension, {entities.begin(), entities.end()}, group.group.second);
    if (!group.name.empty()) gmsh::model::setPhysicalName(dimension, group.group.second, group.name);
  }
}

}  // namespace

std::vector<PhysicalGroup> cut_geometry(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                                        Progress& progress) {
  std::vector<PhysicalGroup> groups;
  session.read(fmt::format("'{}' cannot be cut", source.name), [&] {
    if (is_open_cascade()) {
      const std::vector<NumberedGroup> numbered = numbered_groups();
      restore_groups(numbered, divide(request.cuts, source.metres));
    } else {
      progress.note(
          fmt::format("'{}' is a geometry of gmsh's own kernel, which cannot be cut: the cuts follow faces of "
                      "elements; SetFactory(\"OpenCASCADE\") in its first line may serve",
                      source.name));
    }
    groups = physical_groups();
  });
  return groups;
}

}  // namespace bielle::reduce
