#include "reduce/matrices/set_units.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

const UnitSystem& unit_system_of(const std::string& name) {
  const auto* found = std::find_if(unit_systems.begin(), unit_systems.end(),
                                   [&](const UnitSystem& system) { return name == system.name; });
  if (found != unit_systems.end()) return *found;
  std::vector<std::string> names;
  for (const UnitSystem& system : unit_systems) names.emplace_back(system.name);
  throw InputError(
      fmt::format("--units {}: expected one of {}{}", name, fmt::join(names, ", "), did_you_mean(name, names)));
}

void convert_to_SI(const UnitSystem& units, MatrixSet& set) {
  const double energy = units.mass * units.length * units.length / (units.time * units.time);
  Eigen::VectorXd inverse(set.size());  // units of the file's unknowns in those of SI: [m], [rad], [m kg^1/2]
  for (Eigen::Index k = 0; k < set.size(); ++k) {
    const NodalUnknown& u = set.unknowns[static_cast<std::size_t>(k)];
    inverse(k) = u.is_scalar() ? 1 / (units.length * std::sqrt(units.mass)) : u.is_rotation() ? 1 : 1 / units.length;
  }
  const auto convert = [&](SparseColumns& matrix, double factor) {
    if (matrix.size() == 0) return;
    const SparseColumns scaled = inverse.asDiagonal() * matrix * inverse.asDiagonal();
    matrix = factor * scaled;
  };
  convert(set.stiffness, energy);
  convert(set.geometric_stiffness, energy);
  convert(set.damping, energy * units.time);
  convert(set.mass, energy * units.time * units.time);
  for (Eigen::MatrixXd& part : set.inertia_components)
    if (part.size() > 0)
      part = Eigen::MatrixXd(energy * units.time * units.time * (inverse.asDiagonal() * part * inverse.asDiagonal()));
  set.positions *= units.length;
  if (set.stated) {
    set.stated->mass *= units.mass;
    set.stated->centre *= units.length;
    set.stated->inertia *= units.mass * units.length * units.length;
  }
  if (set.shapes) {
    NodalShapes& shapes = *set.shapes;
    shapes.points *= units.length;
    shapes.displacement = Eigen::MatrixXd(units.length * shapes.displacement * inverse.asDiagonal());
    if (shapes.rotation.size() > 0) shapes.rotation = Eigen::MatrixXd(shapes.rotation * inverse.asDiagonal());
    shapes.masses *= units.mass;
    for (Eigen::Matrix3d& inertia : shapes.inertias) inertia *= units.mass * units.length * units.length;
  }
  set.has_units = true;
}

}  // namespace bielle::reduce
