#include <algorithm>
#include <cmath>

#include "mechanism/joints/gears/gear_mesh.hpp"

namespace bielle::mechanism {

void RigidGearMesh::declare(Declaration& declaration) const {
  GearMesh::declare(declaration);
  declaration.multipliers.push_back({"teeth", "N"});
}

template <int order>
MeshMeasureOf<order> RigidGearMesh::gap(const LocalState& state) const {
  const ToothGeometry& g = contact().geometry();
  auto gap = contact().approach<order>(g.t, state);
  if (!errors().is_zero()) gap += 1 / std::cos(g.pressure_angle) * error<order>(state);
  return gap;
}

void RigidGearMesh::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const MeshSlope m = gap<1>(state);
  r.head<18>() += state.multiplier()[0] * m.gradient;
  r[18] += m.value;
}

void RigidGearMesh::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const MeshMeasure m = gap<2>(state);
  auto K = tangent.K.dense();
  K.topLeftCorner<18, 18>() += state.multiplier()[0] * m.second;
  K.block<18, 1>(0, 18) += m.gradient;
  K.block<1, 18>(18, 0) += m.gradient.transpose();
}

void RigidGearMesh::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                         Eigen::Ref<VectorX> acceleration) const {
  const MeshMeasure m = gap<2>(state);
  const MeshMeasure::Gradient v = ToothContact::rates(state);
  velocity[0] += m.rate(v);
  acceleration[0] += m.acceleration(v, ToothContact::accelerations(state));
}

std::array<double, 2> RigidGearMesh::flank_forces(const LocalState& state) const {
  const double normal = state.reaction()[0] / std::cos(contact().geometry().pressure_angle);
  return {std::max(0.0, normal), std::max(0.0, -normal)};
}

double RigidGearMesh::calc_force(const LocalState& state, MeasureGradient& gradient) const {
  const double per_force = 1 / std::cos(contact().geometry().pressure_angle);
  gradient.position()[state.slots().multiplier_row()] = per_force;
  return per_force * state.reaction()[0];
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
  const MeshSlope m = mesh_.contact().approach<1>(mesh_.contact().geometry().nu, of_mesh);
  r.segment<18>(state.slots().reference_row(0)) += slope_ * std::abs(of_mesh.reaction()[0]) * m.gradient;
}

void GearSeparation::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  const LocalState of_mesh = state.of(0);
  const double lambda = of_mesh.reaction()[0];
  const MeshMeasure m = mesh_.contact().approach<2>(mesh_.contact().geometry().nu, of_mesh);
  const int at = state.slots().reference_row(0);
  auto K = tangent.K.dense();
  K.block<18, 18>(at, at) += slope_ * std::abs(lambda) * m.second;
  K.block<18, 1>(at, at + 18) += std::copysign(slope_, lambda) * m.gradient;
}

void GearSeparation::add_energy(const LocalState& state, Energy& energy) const {
  const LocalState of_mesh = state.of(0);
  const MeshSlope m = mesh_.contact().approach<1>(mesh_.contact().geometry().nu, of_mesh);
  energy.input -= slope_ * std::abs(of_mesh.reaction()[0]) * m.rate(ToothContact::rates(of_mesh));
}

}  // namespace bielle::mechanism
