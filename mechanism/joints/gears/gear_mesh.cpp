#include "mechanism/joints/gears/gear_mesh.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

GearMesh::GearMesh(std::string name, std::array<int, 3> nodes, std::array<std::string, 3> names,
                   const ToothGeometry& geometry, MeshFunction errors)
    : Component("gear_mesh", std::move(name)),
      nodes_(nodes),
      names_(std::move(names)),
      contact_(geometry),
      errors_(std::move(errors)) {}

void GearMesh::declare(Declaration& declaration) const {
  declaration.nodes.assign(nodes_.begin(), nodes_.end());
  declaration.stiffness = true;
  ToothContact::declare_memory(declaration);
}

void GearMesh::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const { contact_.accept(state, memory); }

std::vector<OutputField> GearMesh::output_fields() const {
  return {
      {"approach", {}, "m", "how far the teeth of wheel 1 have moved ahead of those of wheel 2, in the pitch plane"},
      {"force", {2}, "N", "normal forces of the flanks that drive wheel 2 forwards and backwards"},
      {"transmission_error",
       {},
       "m",
       "how far the teeth of wheel 2 are ahead of those of wheel 1, along their normal"}};
}

void GearMesh::write_output(const LocalState& state, double* values) const {
  values[0] = contact_.approach<1>(contact_.geometry().t, state).value;
  const std::array<double, 2> forces = flank_forces(state);
  values[1] = forces[0];
  values[2] = forces[1];
  values[3] = transmission_error(state).value;
}

MeshSlope GearMesh::transmission_error(const LocalState& state) const {
  const ToothGeometry& g = contact_.geometry();
  return -std::cos(g.pressure_angle) * contact_.approach<1>(g.t, state);
}

void GearMesh::describe(const LocalState& state, Description& description) const {
  const ToothGeometry& g = contact_.geometry();
  const NodeState& carrier = state.node(0);
  description.add(fmt::format("wheels '{}' and '{}' on '{}'", names_[1], names_[2], names_[0]));
  description.add(fmt::format("teeth meet at {} m", format_vector(carrier.x + carrier.R * g.P)));
  description.add(
      fmt::format("rate of '{}' over that of '{}' {:.10g}", names_[2], names_[1], contact_.arm(0) / contact_.arm(1)));
  if (!errors_.is_zero()) description.add(fmt::format("error of the teeth as drawn {:.6g} m", errors_.value({0, 0})));
}

/// Draws the wheels as discs through the point where the teeth meet. The larger of two parallel wheels is a ring if
/// both axes are on the same side of that point.
void GearMesh::draw(Drawing& drawing) const {
  const ToothGeometry& g = contact_.geometry();
  std::array<Vector3, 2> arm;  // from each axis to the pitch point, in the carrier's axes
  std::array<double, 2> along{};
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector3 way = g.P - g.centre[k];
    along[k] = g.axis[k].dot(way);
    arm[k] = way - along[k] * g.axis[k];
  }
  const bool internal = g.axis[0].cross(g.axis[1]).norm() < 1e-6 && arm[0].dot(arm[1]) > 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Frame wheel{along[k] * g.wheel[k].col(2), g.wheel[k]};
    const bool inner = internal && arm[k].norm() > arm[1 - k].norm();
    drawing.add(
        {.shape = "gear", .places = {{nodes_[k + 1], wheel}}, .values = {{"radius", arm[k].norm()}, {"inner", inner}}});
  }
}

}  // namespace bielle::mechanism
