#include "reduce/matrices/superelement_set.hpp"

namespace bielle::reduce {

MatrixSet matrix_set_of(const Superelement& body) {
  MatrixSet set;
  set.name = body.name;
  set.source = "superelement of " + (body.created_by.empty() ? "an unnamed program" : body.created_by);
  set.has_units = true;
  set.positions.resize(3, static_cast<Eigen::Index>(body.interfaces.size()));
  for (std::size_t i = 0; i < body.interfaces.size(); ++i) {
    const Interface& interface = body.interfaces[i];
    set.numbers.push_back(static_cast<std::int64_t>(i) + 1);
    set.positions.col(static_cast<Eigen::Index>(i)) = interface.position;
    set.axes.push_back(interface.rotation);
    set.interfaces[interface.name] = static_cast<int>(i);
    for (int component = 0; component < 6; ++component)
      if (interface.kept[static_cast<std::size_t>(component)]) set.unknowns.push_back({static_cast<int>(i), component});
  }
  for (int k = 0; k < body.modes(); ++k) set.unknowns.push_back({-1, k});
  set.stiffness = body.stiffness.sparseView();
  set.mass = body.mass.sparseView();
  set.damping = body.damping.sparseView();
  set.inertia_components = body.inertia_components;
  set.stated = StatedMass{body.total_mass, body.centre, body.inertia};
  set.quantities = body.quantities;
  if (body.displacement_recovery.size() == 0) return set;
  NodalShapes shapes;
  shapes.points = body.mesh.points;
  for (Eigen::Index p = 0; p < shapes.points.cols(); ++p) shapes.numbers.push_back(p);
  shapes.displacement = body.displacement_recovery;
  shapes.cells = body.mesh.cells;
  shapes.stress = body.stress_recovery;
  shapes.stress_points = body.stress_nodes;
  set.shapes = std::move(shapes);
  return set;
}

}  // namespace bielle::reduce
