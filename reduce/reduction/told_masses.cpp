#include "reduce/reduction/told_masses.hpp"

#include <limits>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

/// A place and the box along the axes of the body, around one cell, that is nearest to it.
struct NearestCell {
  double distance = std::numeric_limits<double>::infinity();  ///< [m], 0 inside the box
  double length = 0;                                          ///< longest side of the box [m]
};

NearestCell nearest_cell(const Solid& solid, const Eigen::Vector3d& place) {
  NearestCell nearest;
  for (int e = 0; e < solid.cells.size() && nearest.distance > 0; ++e) {
    const Eigen::Matrix3Xd corners = solid.cells.corner_points(e);
    const Eigen::Vector3d low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
    const double distance = (place - place.cwiseMax(low).cwiseMin(high)).norm();
    if (distance < nearest.distance) nearest = {distance, (high - low).maxCoeff()};
  }
  return nearest;
}

}  // namespace

std::vector<std::string> told_masses(const Solid& solid, const AddedMasses& masses, const ReductionOptions& options) {
  std::vector<std::string> told;
  for (const AddedMass& mass : masses)
    told.push_back(fmt::format("masses.{}: {:.6g} kg with the centre {} follow {}", mass.name, mass.mass,
                               place_name(mass.position), counted(mass.surface.nodes.size(), "node")));
  for (const MassRequest& request : options.masses) {
    if (!request.place) continue;
    const NearestCell cell = nearest_cell(solid, *request.place);
    if (cell.distance <= 0.5 * cell.length) continue;
    told.push_back(
        fmt::format("masses.{}: its place {} is {} outside of the mesh, whose elements are {} long there: it follows "
                    "the nearest nodes; a centre off the body is its `position`",
                    request.name, place_name(*request.place), length_name(cell.distance), length_name(cell.length)));
  }
  for (const CoatingRequest& coating : options.coatings) {
    const double area = integrate_surface(solid.mesh, coating.group).area;
    told.push_back(fmt::format("masses.{}: {:.6g} kg/m^2 on {:.6g} m^2 are {:.6g} kg", coating.name,
                               coating.mass_per_area, area, area * coating.mass_per_area));
  }
  return told;
}

}  // namespace bielle::reduce
