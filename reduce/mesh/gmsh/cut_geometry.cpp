#include "reduce/mesh/gmsh/cut_geometry.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/progress.hpp"
#include "reduce/mesh/gmsh/fragments.hpp"

namespace bielle::reduce {

namespace {

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

}  // namespace

std::vector<PhysicalGroup> cut_geometry(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                                        Progress& progress) {
  std::vector<PhysicalGroup> groups;
  session.read(fmt::format("'{}' cannot be cut", source.name), [&] {
    if (is_open_cascade()) {
      const std::vector<NumberedGroup> numbered = numbered_groups();
      std::vector<Entity> squares;
      for (const CutPlane& plane : request.cuts) squares.push_back(add_square(plane, source.metres));
      restore_groups(numbered, divide_volumes(squares));
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
