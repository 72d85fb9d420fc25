#include "mechanism/joints/friction/bristle_friction.hpp"

#include <algorithm>

namespace bielle::mechanism {

void BristleFriction::declare(Declaration& declaration) const {
  JointFriction::declare(declaration);
  for (int k = 0; k < size(); ++k) {
    const auto along = [&](const FrictionSurface::Part& part) { return part.component == k; };
    const auto part = std::find_if(surface().parts.begin(), surface().parts.end(), along);
    Declaration::Scalar z{"bristle of " + joint().coordinates()[part->coordinate].name, "m"};
    z.scale = law().kinetic / law().bristle_stiffness;
    z.equation_units = "m/s";
    z.holdable = true;
    declaration.first_order.push_back(std::move(z));
  }
}

BristleFriction::Rate BristleFriction::rate(const Vector& z, const Vector& v) const {
  const double s = v.norm(), stiffness = law().bristle_stiffness;
  const auto [mu, slope] = law().level(s);
  Rate result{v - stiffness * s / mu * z, Matrix::Identity(size(), size()), Matrix::Identity(size(), size())};
  result.by_z *= -stiffness * s / mu;
  if (s > 0) result.by_v -= stiffness * (1 / mu - s * s * slope / (mu * mu)) * z * (v / s).transpose();
  return result;
}

JointFriction::Resistance BristleFriction::resistance(const LocalState& state, const Vector& v) const {
  const Vector z = state.first_order();
  const Rate zdot = rate(z, v);
  const auto [damping, slope] = law().bristle_damping_at(v.norm());
  Resistance result{law().bristle_stiffness * z + damping * zdot.u + law().viscous * v,
                    damping * zdot.by_v + slope * zdot.u * v.transpose(), damping * zdot.by_z};
  result.by_v.diagonal().array() += law().viscous;
  result.by_z.diagonal().array() += law().bristle_stiffness;
  return result;
}

double BristleFriction::loss(const LocalState& state, const Vector& v, const Resistance& resistance) const {
  const Vector z = state.first_order();
  return resistance.rho.dot(v) - law().bristle_stiffness * z.dot(rate(z, v).u);
}

void BristleFriction::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  JointFriction::add_residual(state, r);
  const Rate zdot = rate(state.first_order(), velocity(state));
  for (int k = 0; k < size(); ++k)
    if (!state.held(k)) r[k] += state.first_order_rate()[k] - zdot.u[k];
}

void BristleFriction::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  JointFriction::add_tangent(state, tangent);
  const Slip& s = slip(state, true);
  const Rate zdot = rate(state.first_order(), s.v);
  const int at = row(state), n = static_cast<int>(s.w.rows());
  for (int k = 0; k < size(); ++k) {
    if (state.held(k)) {
      if (tangent.wants_K) tangent.K.dense()(k, k) += 1;
      continue;
    }
    if (tangent.wants_K) {
      auto K = tangent.K.dense();
      K.block(k, 0, 1, size()) -= zdot.by_z.row(k);
      K.block(k, at, 1, n).noalias() -= zdot.by_v.row(k) * s.by_position.transpose();
    }
    if (tangent.wants_C) {
      auto C = tangent.C.dense();
      C(k, k) += 1;
      C.block(k, at, 1, n).noalias() -= zdot.by_v.row(k) * s.w.transpose();
    }
  }
}

std::vector<OutputField> BristleFriction::output_fields() const {
  std::vector<OutputField> fields = JointFriction::output_fields();
  fields.push_back(by_coordinate("bristles", "m", "deflections of the bristles along the coordinates"));
  return fields;
}

void BristleFriction::write_output(const LocalState& state, double* values) const {
  JointFriction::write_output(state, values);
  write_by_coordinate(state.first_order(), values + 2 * joint().coordinates().size());
}

}  // namespace bielle::mechanism
