#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/gears/gear_mesh.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

ElasticGearMesh::ElasticGearMesh(std::string name, std::array<int, 3> nodes, std::array<std::string, 3> names,
                                 const ToothGeometry& geometry, MeshFunction errors, ToothSpring spring)
    : GearMesh(std::move(name), nodes, std::move(names), geometry, std::move(errors)), spring_(std::move(spring)) {}

void ElasticGearMesh::declare(Declaration& declaration) const {
  GearMesh::declare(declaration);
  declaration.damping = spring_.damping > 0;
  declaration.kinks = true;  // the force has a kink at zero
  const double touch = plays() ? 0 : 1;
  declaration.memory.insert(declaration.memory.end(), {touch, touch});  // whether each flank touches
  if (plays()) declaration.event_functions = {{"teeth touch, forwards"}, {"teeth touch, backwards"}};
}

Vector3 ElasticGearMesh::normal(int side) const {
  const ToothGeometry& g = contact().geometry();
  return (side == 0 ? 1 : -1) * std::cos(g.pressure_angle) * g.t + std::sin(g.pressure_angle) * g.nu;
}

template <int order>
MeshMeasureOf<order> ElasticGearMesh::stiffness(const LocalState& state) const {
  const auto k = spring_.stiffness.calc<order>(contact(), state);
  if (!(k.value > 0))
    throw ComputationError(fmt::format(
        "the stiffness of the teeth of '{}' is {:.6g} N/m at the angles {:.6g} and {:.6g} rad of its wheels; "
        "it has to be positive",
        name(), k.value, contact().turned<1>(0, state).value, contact().turned<1>(1, state).value));
  return k;
}

template MeshSlope ElasticGearMesh::stiffness(const LocalState&) const;

template <int order>
MeshMeasureOf<order> ElasticGearMesh::penetration(int side, const MeshMeasureOf<order>& error,
                                                  const LocalState& state) const {
  auto p = contact().approach<order>(normal(side), state) - 0.5 * spring_.backlash;
  if (!errors().is_zero()) p += (side == 0 ? 1.0 : -1.0) * error;
  return p;
}

template <int order>
ElasticGearMesh::Flank<order> ElasticGearMesh::flank(int side, double stiffness, const MeshMeasureOf<order>& error,
                                                     const LocalState& state) const {
  Flank<order> flank;
  flank.p = penetration<order>(side, error, state);
  flank.rate = flank.p.rate(ToothContact::rates(state));
  // Without play, one of the flanks is always loaded, and a change between them causes no jump.
  flank.touches = !plays() || (state.environment().statics ? flank.p.value >= 0
                                                           : state.memory()[ToothContact::memories + side] != 0);
  const double push = stiffness * flank.p.value + spring_.damping * flank.rate;
  // Without play and load, both flanks are at zero. Only one of them counts, because the stiffness would otherwise be
  // doubled.
  flank.pushes = flank.touches && (push > 0 || (push == 0 && (plays() || side == 0)));
  flank.force = flank.pushes ? push : 0;
  flank.pressed = !flank.touches ? 0 : plays() ? flank.p.value : std::max(0.0, flank.p.value);
  return flank;
}

std::array<double, 2> ElasticGearMesh::flank_forces(const LocalState& state) const {
  const double k = stiffness<1>(state).value;
  const MeshSlope e = error<1>(state);
  return {flank<1>(0, k, e, state).force, flank<1>(1, k, e, state).force};
}

MeshSlope ElasticGearMesh::deformation(const LocalState& state) const {
  const MeshSlope e = error<1>(state);
  const MeshSlope forwards = penetration<1>(0, e, state), backwards = penetration<1>(1, e, state);
  return forwards.value >= backwards.value ? forwards : backwards;
}

void ElasticGearMesh::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const MeshSlope k = stiffness<1>(state), e = error<1>(state);
  for (const int side : {0, 1}) {
    const Flank<1> f = flank<1>(side, k.value, e, state);
    if (f.pushes) r.head<18>() += f.force * f.p.gradient;
    if (spring_.stiffness.varies()) r.head<18>() += 0.5 * f.pressed * f.pressed * k.gradient;
  }
}

MeshMeasure::Gradient ElasticGearMesh::force_gradient(const Flank<2>& flank, const MeshMeasure& stiffness,
                                                      const LocalState& state) const {
  return stiffness.value * flank.p.gradient + flank.p.value * stiffness.gradient +
         spring_.damping * (flank.p.second.transpose() * ToothContact::rates(state));
}

void ElasticGearMesh::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const MeshMeasure k = stiffness<2>(state), e = error<2>(state);
  for (const int side : {0, 1}) {
    const Flank<2> f = flank<2>(side, k.value, e, state);
    const MeshMeasure::Gradient& g = f.p.gradient;
    if (tangent.wants_K && f.pushes)
      tangent.K.dense() += f.force * f.p.second + g * force_gradient(f, k, state).transpose();
    if (tangent.wants_K && spring_.stiffness.varies() && f.pressed != 0)
      tangent.K.dense() += 0.5 * f.pressed * f.pressed * k.second + f.pressed * k.gradient * g.transpose();
    if (tangent.wants_C && f.pushes && spring_.damping > 0) tangent.C.dense() += spring_.damping * g * g.transpose();
  }
}

double ElasticGearMesh::calc_force(const LocalState& state, MeasureGradient& gradient) const {
  const MeshMeasure k = stiffness<2>(state), e = error<2>(state);
  double force = 0;
  for (const int side : {0, 1}) {
    const Flank<2> f = flank<2>(side, k.value, e, state);
    if (!f.pushes) continue;
    const double sign = side == 0 ? 1 : -1;
    force += sign * f.force;
    gradient.position().head<18>() += sign * force_gradient(f, k, state);
    gradient.rate().head<18>() += sign * spring_.damping * f.p.gradient;
  }
  return force;
}

void ElasticGearMesh::add_energy(const LocalState& state, Energy& energy) const {
  const double k = stiffness<1>(state).value;
  const MeshSlope e = error<1>(state);
  for (const int side : {0, 1}) {
    const Flank<1> f = flank<1>(side, k, e, state);
    energy.elastic += 0.5 * k * f.pressed * f.pressed;
    energy.dissipation += (f.force - k * f.pressed) * f.rate;
  }
}

void ElasticGearMesh::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  if (!plays()) return;
  const MeshSlope e = error<1>(state);
  for (const int side : {0, 1}) values[side] = penetration<1>(side, e, state).value;
}

bool ElasticGearMesh::leaves_branch(const LocalState& state) const {
  if (!plays()) return false;
  const MeshSlope e = error<1>(state);
  for (const int side : {0, 1})
    if (state.memory()[ToothContact::memories + side] != 0 && penetration<1>(side, e, state).value < 0) return true;
  return false;
}

void ElasticGearMesh::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                                   Eigen::Ref<VectorX> memory) const {
  if (!plays()) return;
  const MeshSlope e = error<1>(state);
  for (const int side : {0, 1}) {
    const MeshSlope p = penetration<1>(side, e, state);
    const bool touches = p.value > 0 || (p.value == 0 && p.rate(ToothContact::rates(state)) >= 0);
    memory[ToothContact::memories + side] = touches ? 1 : 0;
  }
}

void ElasticGearMesh::describe(const LocalState& state, Description& description) const {
  GearMesh::describe(state, description);
  std::string text = fmt::format("tooth stiffness {:.6g} N/m", stiffness<1>(state).value);
  if (spring_.stiffness.varies()) text += " as drawn";
  if (spring_.damping > 0) text += fmt::format(", damping {:.6g} N s/m", spring_.damping);
  if (spring_.backlash > 0) text += fmt::format(", backlash {:.6g} m", spring_.backlash);
  description.add(text);
}

}  // namespace bielle::mechanism
