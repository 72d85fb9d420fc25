#include "mechanism/elements/beam_inertia.hpp"

#include <cmath>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {
namespace {

std::array<const NodeState*, 2> ends(const LocalState& state) { return {&state.node(0), &state.node(1)}; }

constexpr Eigen::Index first_row(std::size_t node) { return 6 * static_cast<Eigen::Index>(node); }

}  // namespace

BeamInertia::BeamInertia(const BeamSection& section, const Matrix3& R_A, const Matrix3& R_B, const Vector3& chord)
    : massless_(section.mass == 0 && section.inertia.isZero(0)) {
  const double L = chord.norm(), mass = section.mass * L;
  const Vector3& c = section.mass_offset;
  const double offset = 0.5 * std::sqrt(0.6);
  const std::array<double, 3> z{0.5 - offset, 0.5, 0.5 + offset}, weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (std::size_t g = 0; g < 3; ++g) {
    const Vector3 bubble = 0.5 * z[g] * (1 - z[g]) * chord;
    points_[g] = {mass * weight[g], {1 - z[g], z[g]}, {R_A * ((1 - z[g]) * c + bubble), R_B * (z[g] * c - bubble)}};
  }
  points_[3] = {mass / 12, {-1, 1}, {R_A * (-c - 0.5 * chord), R_B * (c - 0.5 * chord)}};
  const Vector3 t = chord / L;
  const Matrix3 torsional = L / 12 * t.dot(section.inertia * t) * t * t.transpose();
  const Matrix3 own = L / 2 * section.inertia - torsional;
  J_[0] = {R_A * own * R_A.transpose(), R_A * torsional * R_B.transpose()};
  J_[1] = {R_B * torsional * R_A.transpose(), R_B * own * R_B.transpose()};
}

void BeamInertia::add_force(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const auto node = ends(state);
  for (const Point& p : points_) {
    Vector3 f = Vector3::Zero();
    for (std::size_t k = 0; k < 2; ++k) {
      const NodeState& n = *node[k];
      f += p.N[k] * (n.a - state.environment().gravity) +
           n.R * (n.Omegadot.cross(p.a[k]) + n.Omega.cross(n.Omega.cross(p.a[k])));
    }
    f *= p.w;
    for (std::size_t k = 0; k < 2; ++k) {
      r.segment<3>(first_row(k)) += p.N[k] * f;
      r.segment<3>(first_row(k) + 3) += p.a[k].cross(node[k]->R.transpose() * f);
    }
  }
  for (std::size_t k = 0; k < 2; ++k)
    r.segment<3>(first_row(k) + 3) += J_[k][0] * node[0]->Omegadot + J_[k][1] * node[1]->Omegadot +
                                      node[k]->Omega.cross(J_[k][0] * node[0]->Omega + J_[k][1] * node[1]->Omega);
}

// Each point moves by B [dx_A; dTheta_A; dx_B; dTheta_B], B_k = [N_k I, -R_k a_k~]; with its inertia force f
//   M = w B^T B,   C = w B^T [0, -R_k ((Omega_k~ a_k)~ + Omega_k~ a_k~)],
//   K = w B^T [0, -R_k (Omegadot_k~ a_k + Omega_k~ Omega_k~ a_k)~] + diag(0, a_k~ (R_k^T f)~);
// rotary inertia, with p_k = sum_l J_kl Omega_l:   M = J_kl,   C = Omega_k~ J_kl - delta_kl p_k~.
void BeamInertia::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const auto node = ends(state);
  using Rows = Eigen::Matrix<double, 3, 12>;
  for (const Point& p : points_) {
    Rows B = Rows::Zero(), V = Rows::Zero(), W = Rows::Zero();
    Vector3 f = Vector3::Zero();
    for (std::size_t k = 0; k < 2; ++k) {
      const NodeState& n = *node[k];
      const Eigen::Index column = first_row(k);
      const Matrix3 a_k = skew(p.a[k]);
      const Vector3 turning = n.Omega.cross(p.a[k]);
      const Vector3 convected = n.Omegadot.cross(p.a[k]) + n.Omega.cross(turning);
      B.middleCols<3>(column).diagonal().setConstant(p.N[k]);
      B.middleCols<3>(column + 3) = -n.R * a_k;
      V.middleCols<3>(column + 3) = -n.R * (skew(turning) + skew(n.Omega) * a_k);
      W.middleCols<3>(column + 3) = -n.R * skew(convected);
      f += p.w * (p.N[k] * (n.a - state.environment().gravity) + n.R * convected);
    }
    if (tangent.wants_M) tangent.M.topLeftCorner<12, 12>() += p.w * B.transpose() * B;
    if (tangent.wants_C) tangent.C.topLeftCorner<12, 12>() += p.w * B.transpose() * V;
    if (!tangent.wants_K) continue;
    tangent.K.topLeftCorner<12, 12>() += p.w * B.transpose() * W;
    for (std::size_t k = 0; k < 2; ++k)
      tangent.K.block<3, 3>(first_row(k) + 3, first_row(k) + 3) += skew(p.a[k]) * skew(node[k]->R.transpose() * f);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Eigen::Index row = first_row(k) + 3;
    for (std::size_t l = 0; l < 2; ++l) {
      if (tangent.wants_M) tangent.M.block<3, 3>(row, first_row(l) + 3) += J_[k][l];
      if (tangent.wants_C) tangent.C.block<3, 3>(row, first_row(l) + 3) += skew(node[k]->Omega) * J_[k][l];
    }
    if (tangent.wants_C) tangent.C.block<3, 3>(row, row) -= skew(J_[k][0] * node[0]->Omega + J_[k][1] * node[1]->Omega);
  }
}

void BeamInertia::add_energy(const LocalState& state, Energy& energy) const {
  const auto node = ends(state);
  for (const Point& p : points_) {
    Vector3 x = Vector3::Zero(), v = Vector3::Zero();
    for (std::size_t k = 0; k < 2; ++k) {
      const NodeState& n = *node[k];
      x += p.N[k] * n.x + n.R * p.a[k];
      v += p.N[k] * n.v + n.R * n.Omega.cross(p.a[k]);
    }
    energy.kinetic += 0.5 * p.w * v.squaredNorm();
    energy.gravity -= p.w * (p.N[0] + p.N[1]) * state.environment().gravity.dot(x);
  }
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t l = 0; l < 2; ++l) energy.kinetic += 0.5 * node[k]->Omega.dot(J_[k][l] * node[l]->Omega);
}

}  // namespace bielle::mechanism
