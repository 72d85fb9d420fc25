#include "mechanism/elements/beam/beam_inertia.hpp"

#include <cmath>

#include "mechanism/math/gauss.hpp"
#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {
namespace {

std::array<const NodeState*, 2> ends(const LocalState& state) { return {&state.node(0), &state.node(1)}; }

constexpr Eigen::Index first_row(std::size_t node) { return 6 * static_cast<Eigen::Index>(node); }

/// Tangent of the line of mass centres at c, from the derivative of the section frame.
Vector3 tangent_of(const Vector6& rate, const Vector3& c) { return rate.head<3>() + rate.tail<3>().cross(c); }

}  // namespace

BeamInertia::BeamInertia(const ElementSections& sections, const Matrix3& R_A, const Matrix3& R_B,
                         const BeamReference& reference) {
  const double L = reference.length;
  const Vector3 t = reference.d0.head<3>().normalized();
  double mass = 0;  // mean per length
  Vector3 moment = Vector3::Zero();
  Matrix3 J_A = Matrix3::Zero(), J_B = Matrix3::Zero();
  for (std::size_t g = 0; g < 3; ++g) {
    const BeamSection& section = sections.at[g];
    const Vector3& c = section.mass_offset;
    const double z = Gauss3::place[g], w = Gauss3::weight[g];
    const double bubble = 0.5 * z * (1 - z);
    points_[g] = {section.mass * L * w,
                  {1 - z, z},
                  {R_A * ((1 - z) * c + bubble * tangent_of(reference.rate_A, c)),
                   R_B * (z * c - bubble * tangent_of(reference.rate_B, c))}};
    mass += w * section.mass;
    moment += w * section.mass * c;
    J_A += w * (1 - z) * L * section.inertia;
    J_B += w * z * L * section.inertia;
  }
  const Vector3 c = mass > 0 ? Vector3(moment / mass) : Vector3::Zero();
  points_[3] = {
      mass * L / 12,
      {-1, 1},
      {R_A * (-c - 0.5 * tangent_of(reference.rate_A, c)), R_B * (c - 0.5 * tangent_of(reference.rate_B, c))}};
  const Matrix3 torsional = t.dot((J_A + J_B) * t) / 12 * t * t.transpose();
  J_[0] = {R_A * (J_A - torsional) * R_A.transpose(), R_A * torsional * R_B.transpose()};
  J_[1] = {R_B * torsional * R_A.transpose(), R_B * (J_B - torsional) * R_B.transpose()};
  massless_ = mass == 0 && J_A.isZero(0) && J_B.isZero(0);
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

// clang-format off
// Each point moves by sum_k (N_k dx_k + A_k dTheta_k), A_k = -R_k a_k~; with its inertia force f the blocks (i,j) are
//          dx_j       dTheta_j
//   M = w [ N_i N_j I   N_i A_j   ]    C = w [ 0  N_i V_j   ]    K = w [ 0  N_i W_j   ]
//         [ N_j A_i^T   A_i^T A_j ]          [ 0  A_i^T V_j ]          [ 0  A_i^T W_j ],   and a_i~ (R_i^T f)~ in (Theta_i, Theta_i)
//   V_k = -R_k ((Omega_k~ a_k)~ + Omega_k~ a_k~),   W_k = -R_k (Omegadot_k~ a_k + Omega_k~ Omega_k~ a_k)~;
// rotary inertia, with p_k = sum_l J_kl Omega_l:   M = J_kl,   C = Omega_k~ J_kl - delta_kl p_k~.
// clang-format on
void BeamInertia::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const auto node = ends(state);
  auto K = tangent.K.dense(), C = tangent.C.dense(), M = tangent.M.dense();
  for (const Point& p : points_) {
    std::array<Matrix3, 2> A, V, W;
    Vector3 f = Vector3::Zero();
    for (std::size_t k = 0; k < 2; ++k) {
      const NodeState& n = *node[k];
      const Matrix3 a_k = skew(p.a[k]);
      const Vector3 turning = n.Omega.cross(p.a[k]);
      const Vector3 convected = n.Omegadot.cross(p.a[k]) + n.Omega.cross(turning);
      A[k] = -n.R * a_k;
      V[k] = -n.R * (skew(turning) + skew(n.Omega) * a_k);
      W[k] = -n.R * skew(convected);
      f += p.w * (p.N[k] * (n.a - state.environment().gravity) + n.R * convected);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::Index x_i = first_row(i), Theta_i = x_i + 3;
      const Matrix3 wA_i = p.w * A[i].transpose();
      for (std::size_t j = 0; j < 2; ++j) {
        const Eigen::Index x_j = first_row(j), Theta_j = x_j + 3;
        if (tangent.wants_M) {
          M.block<3, 3>(x_i, x_j).diagonal().array() += p.w * p.N[i] * p.N[j];
          M.block<3, 3>(x_i, Theta_j) += p.w * p.N[i] * A[j];
          M.block<3, 3>(Theta_i, x_j) += p.N[j] * wA_i;
          M.block<3, 3>(Theta_i, Theta_j) += wA_i * A[j];
        }
        if (tangent.wants_C) {
          C.block<3, 3>(x_i, Theta_j) += p.w * p.N[i] * V[j];
          C.block<3, 3>(Theta_i, Theta_j) += wA_i * V[j];
        }
        if (tangent.wants_K) {
          K.block<3, 3>(x_i, Theta_j) += p.w * p.N[i] * W[j];
          K.block<3, 3>(Theta_i, Theta_j) += wA_i * W[j];
        }
      }
      if (tangent.wants_K) K.block<3, 3>(Theta_i, Theta_i) += skew(p.a[i]) * skew(node[i]->R.transpose() * f);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Eigen::Index row = first_row(k) + 3;
    for (std::size_t l = 0; l < 2; ++l) {
      if (tangent.wants_M) M.block<3, 3>(row, first_row(l) + 3) += J_[k][l];
      if (tangent.wants_C) C.block<3, 3>(row, first_row(l) + 3) += skew(node[k]->Omega) * J_[k][l];
    }
    if (tangent.wants_C) C.block<3, 3>(row, row) -= skew(J_[k][0] * node[0]->Omega + J_[k][1] * node[1]->Omega);
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
