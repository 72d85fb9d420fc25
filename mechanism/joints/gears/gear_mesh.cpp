#include "mechanism/joints/gears/gear_mesh.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

GearMesh::GearMesh(std::string name, std::array<int, 3> nodes, std::array<std::string, 3> names,
                   const ToothGeometry& geometry)
    : Component("gear_mesh", std::move(name)), nodes_(nodes), names_(std::move(names)), contact_(geometry) {}

void GearMesh::declare(Declaration& declaration) const {
  declaration.nodes.assign(nodes_.begin(), nodes_.end());
  declaration.stiffness = true;
  ToothContact::declare_memory(declaration);
}

void GearMesh::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const { contact_.accept(state, memory); }

std::vector<OutputField> GearMesh::output_fields() const {
  return {
      {"approach", {}, "m", "how far the teeth of wheel 1 have moved ahead of those of wheel 2, in the pitch plane"},
      {"force", {2}, "N", "normal forces of the flanks that drive wheel 2 forwards and backwards"}};
}

void GearMesh::write_output(const LocalState& state, double* values) const {
  values[0] = contact_.approach(contact_.geometry().t, state).value;
  const std::array<double, 2> forces = flank_forces(state);
  values[1] = forces[0];
  values[2] = forces[1];
}

void GearMesh::describe(const LocalState& state, Description& description) const {
  const ToothGeometry& g = contact_.geometry();
  const NodeState& carrier = state.node(0);
  description.add(fmt::format("wheels '{}' and '{}' on '{}'", names_[1], names_[2], names_[0]));
  description.add(fmt::format("teeth meet at {} m", format_vector(carrier.x + carrier.R * g.P)));
  description.add(
      fmt::format("rate of '{}' over that of '{}' {:.10g}", names_[2], names_[1], contact_.arm(0) / contact_.arm(1)));
}

// -- rigid

void RigidGearMesh::declare(Declaration& declaration) const {
  GearMesh::declare(declaration);
  declaration.multipliers.push_back({"teeth", "N"});
}

void RigidGearMesh::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const MeshMeasure m = contact().approach(contact().geometry().t, state);
  r.head<18>() += state.multiplier()[0] * m.gradient;
  r[18] += m.value;
}

void RigidGearMesh::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const MeshMeasure m = contact().approach(contact().geometry().t, state);
  auto K = tangent.K.dense();
  K.topLeftCorner<18, 18>() += state.multiplier()[0] * m.second;
  K.block<18, 1>(0, 18) += m.gradient;
  K.block<1, 18>(18, 0) += m.gradient.transpose();
}

void RigidGearMesh::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                         Eigen::Ref<VectorX> acceleration) const {
  const MeshMeasure m = contact().approach(contact().geometry().t, state);
  const MeshMeasure::Gradient v = ToothContact::rates(state);
  velocity[0] += m.rate(v);
  acceleration[0] += m.acceleration(v, ToothContact::accelerations(state));
}

std::array<double, 2> RigidGearMesh::flank_forces(const LocalState& state) const {
  const double normal = state.reaction()[0] / std::cos(contact().geometry().pressure_angle);
  return {std::max(0.0, normal), std::max(0.0, -normal)};
}

GearSeparation::GearSeparation(std::string name, const RigidGearMesh& mesh)
    : Component("gear_separation", std::move(name)),
      mesh_(mesh),
      slope_(std::tan(mesh.contact().geometry().pressure_angle)) {}

void GearSeparation::declare(Declaration& declaration) const {
  declaration.references = {&mesh_};
  declaration.stiffness = declaration.reads_reactions = declaration.kinks = true;
}

void GearSeparation::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const LocalState of_mesh = state.of(0);
  const MeshMeasure m = mesh_.contact().approach(mesh_.contact().geometry().nu, of_mesh);
  r.segment<18>(state.slots().reference_row(0)) += slope_ * std::abs(of_mesh.reaction()[0]) * m.gradient;
}

void GearSeparation::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const LocalState of_mesh = state.of(0);
  const double lambda = of_mesh.reaction()[0];
  const MeshMeasure m = mesh_.contact().approach(mesh_.contact().geometry().nu, of_mesh);
  const int at = state.slots().reference_row(0);
  auto K = tangent.K.dense();
  K.block<18, 18>(at, at) += slope_ * std::abs(lambda) * m.second;
  K.block<18, 1>(at, at + 18) += std::copysign(slope_, lambda) * m.gradient;
}

void GearSeparation::add_energy(const LocalState& state, Energy& energy) const {
  const LocalState of_mesh = state.of(0);
  const MeshMeasure m = mesh_.contact().approach(mesh_.contact().geometry().nu, of_mesh);
  energy.input -= slope_ * std::abs(of_mesh.reaction()[0]) * m.rate(ToothContact::rates(of_mesh));
}

// -- elastic

ElasticGearMesh::ElasticGearMesh(std::string name, std::array<int, 3> nodes, std::array<std::string, 3> names,
                                 const ToothGeometry& geometry, const ToothSpring& spring)
    : GearMesh(std::move(name), nodes, std::move(names), geometry), spring_(spring) {}

void ElasticGearMesh::declare(Declaration& declaration) const {
  GearMesh::declare(declaration);
  declaration.damping = spring_.damping > 0;
  declaration.kinks = true;  // at zero total force
  const double touch = plays() ? 0 : 1;
  declaration.memory.insert(declaration.memory.end(), {touch, touch});  // whether each flank touches
  if (plays()) declaration.event_functions = {{"teeth touch, forwards"}, {"teeth touch, backwards"}};
}

Vector3 ElasticGearMesh::normal(int side) const {
  const ToothGeometry& g = contact().geometry();
  return (side == 0 ? 1 : -1) * std::cos(g.pressure_angle) * g.t + std::sin(g.pressure_angle) * g.nu;
}

ElasticGearMesh::Flank ElasticGearMesh::flank(int side, const LocalState& state) const {
  Flank flank;
  flank.p = contact().approach(normal(side), state) - 0.5 * spring_.backlash;
  flank.rate = flank.p.rate(ToothContact::rates(state));
  // Without play, one of the flanks is always loaded: nothing jumps when they change.
  flank.touches = !plays() || (state.environment().statics ? flank.p.value >= 0
                                                           : state.memory()[ToothContact::memories + side] != 0);
  const double push = spring_.stiffness * flank.p.value + spring_.damping * flank.rate;
  flank.pushes = flank.touches && push >= 0;
  flank.force = flank.pushes ? push : 0;
  return flank;
}

std::array<double, 2> ElasticGearMesh::flank_forces(const LocalState& state) const {
  return {flank(0, state).force, flank(1, state).force};
}

void ElasticGearMesh::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  for (const int side : {0, 1})
    if (const Flank f = flank(side, state); f.pushes) r.head<18>() += f.force * f.p.gradient;
}

void ElasticGearMesh::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const MeshMeasure::Gradient v = ToothContact::rates(state);
  for (const int side : {0, 1}) {
    const Flank f = flank(side, state);
    if (!f.pushes) continue;
    const MeshMeasure::Gradient& g = f.p.gradient;
    if (tangent.wants_K) {
      const MeshMeasure::Gradient slope = spring_.stiffness * g + spring_.damping * (f.p.second.transpose() * v);
      tangent.K.dense() += f.force * f.p.second + g * slope.transpose();
    }
    if (tangent.wants_C && spring_.damping > 0) tangent.C.dense() += spring_.damping * g * g.transpose();
  }
}

void ElasticGearMesh::add_energy(const LocalState& state, Energy& energy) const {
  for (const int side : {0, 1}) {
    const Flank f = flank(side, state);
    if (!f.touches) continue;
    const double pressed = plays() ? f.p.value : std::max(0.0, f.p.value);
    energy.elastic += 0.5 * spring_.stiffness * pressed * pressed;
    energy.dissipation += (f.force - spring_.stiffness * pressed) * f.rate;
  }
}

void ElasticGearMesh::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  for (int side = 0; side < values.size(); ++side) values[side] = flank(side, state).p.value;
}

bool ElasticGearMesh::leaves_branch(const LocalState& state) const {
  if (!plays()) return false;
  for (const int side : {0, 1})
    if (const Flank f = flank(side, state); f.touches && f.p.value < 0) return true;
  return false;
}

void ElasticGearMesh::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                                   Eigen::Ref<VectorX> memory) const {
  if (!plays()) return;
  for (const int side : {0, 1}) {
    const Flank f = flank(side, state);
    memory[ToothContact::memories + side] = f.p.value > 0 || (f.p.value == 0 && f.rate >= 0) ? 1 : 0;
  }
}

void ElasticGearMesh::describe(const LocalState& state, Description& description) const {
  GearMesh::describe(state, description);
  std::string text = fmt::format("tooth stiffness {:.6g} N/m", spring_.stiffness);
  if (spring_.damping > 0) text += fmt::format(", damping {:.6g} N s/m", spring_.damping);
  if (spring_.backlash > 0) text += fmt::format(", backlash {:.6g} m", spring_.backlash);
  description.add(text);
}

/// Wheels are discs through the point where the teeth meet. The larger of two parallel wheels is a ring if both axes
/// are on the same side of that point.
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
