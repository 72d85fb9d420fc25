#include "mechanism/elements/beam/beam_inertia.hpp"

#include <cmath>

#include "mechanism/math/gauss.hpp"
#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {
namespace {

constexpr Eigen::Index first_row(std::size_t node) { return 6 * static_cast<Eigen::Index>(node); }

/// A mass w at sum_k (N_k x_k + R_k a_k), k = A, B.
struct Point {
  double w = 0;  ///< [kg]
  std::array<double, 2> N{};
  std::array<Vector3, 2> a;  ///< [m], node axes
};

/// Returns the vector a x b of a matrix a b^T.
Vector3 axial(const Matrix3& A) { return {A(1, 2) - A(2, 1), A(2, 0) - A(0, 2), A(0, 1) - A(1, 0)}; }

/// Returns sum a~ B b~ of a matrix T = sum a b^T.
Matrix3 skewed(const Matrix3& T, const Matrix3& B) {
  Matrix3 sum;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      sum(i, j) = B(i1, j2) * T(i2, j1) - B(i1, j1) * T(i2, j2) - B(i2, j2) * T(i1, j1) + B(i2, j1) * T(i1, j2);
    }
  return sum;
}

/// Returns the tangent of the line of mass centres at c, from the derivative of the section frame.
Vector3 tangent_of(const Vector6& rate, const Vector3& c) { return rate.head<3>() + rate.tail<3>().cross(c); }

}  // namespace

BeamInertia::BeamInertia(const ElementSections& sections, const Matrix3& R_A, const Matrix3& R_B,
                         const BeamReference& reference) {
  const double L = reference.length;
  const Vector3 t = reference.d0.head<3>().normalized();
  std::array<Point, 4> points;
  double mass = 0;  // mean per length
  Vector3 moment = Vector3::Zero();
  Matrix3 J_A = Matrix3::Zero(), J_B = Matrix3::Zero();
  for (std::size_t g = 0; g < 3; ++g) {
    const BeamSection& section = sections.at[g];
    const Vector3& c = section.mass_offset;
    const double z = Gauss3::place[g], w = Gauss3::weight[g];
    const double bubble = 0.5 * z * (1 - z);
    points[g] = {section.mass * L * w,
                 {1 - z, z},
                 {R_A * ((1 - z) * c + bubble * tangent_of(reference.rate_A, c)),
                  R_B * (z * c - bubble * tangent_of(reference.rate_B, c))}};
    mass += w * section.mass;
    moment += w * section.mass * c;
    J_A += w * (1 - z) * L * section.inertia;
    J_B += w * z * L * section.inertia;
  }
  const Vector3 c = mass > 0 ? Vector3(moment / mass) : Vector3::Zero();
  points[3] = {mass * L / 12,
               {-1, 1},
               {R_A * (-c - 0.5 * tangent_of(reference.rate_A, c)), R_B * (c - 0.5 * tangent_of(reference.rate_B, c))}};
  const Matrix3 torsional = t.dot((J_A + J_B) * t) / 12 * t * t.transpose();
  J_[0] = {R_A * (J_A - torsional) * R_A.transpose(), R_A * torsional * R_B.transpose()};
  J_[1] = {R_B * torsional * R_A.transpose(), R_B * (J_B - torsional) * R_B.transpose()};
  T_.setZero();
  for (auto& of_node : s_) of_node.fill(Vector3::Zero());
  massless_ = mass == 0 && J_A.isZero(0) && J_B.isZero(0);
  for (const Point& p : points) {
    T_ += p.w * p.a[0] * p.a[1].transpose();
    for (std::size_t i = 0; i < 2; ++i) {
      J_[i][i] += p.w * skew(p.a[i]).transpose() * skew(p.a[i]);
      for (std::size_t j = 0; j < 2; ++j) {
        m_[i][j] += p.w * p.N[i] * p.N[j];
        s_[i][j] += p.w * p.N[i] * p.a[j];
      }
    }
  }
}

struct BeamInertia::Turning {
  std::array<const NodeState*, 2> node;
  std::array<Vector3, 2> pull;     ///< xddot_k - g
  std::array<Matrix3, 2> Z;        ///< Omegadot~ + Omega~ Omega~: Z a is the acceleration of R a, in node axes
  Matrix3 R_AB;                    ///< R_A^T R_B
  std::array<Matrix3, 2> moments;  ///< sum w a_A (R_AB Z_B a_B)^T, sum w a_B (R_AB^T Z_A a_A)^T [N m]
};

BeamInertia::Turning BeamInertia::turning(const LocalState& state) const {
  Turning t;
  t.node = {&state.node(0), &state.node(1)};
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector3& Omega = t.node[k]->Omega;
    t.pull[k] = t.node[k]->a - state.environment().gravity;
    t.Z[k] = Omega * Omega.transpose() + skew(t.node[k]->Omegadot);
    t.Z[k].diagonal().array() -= Omega.squaredNorm();
  }
  t.R_AB.noalias() = t.node[0]->R.transpose() * t.node[1]->R;
  t.moments[0].noalias() = (T_ * t.Z[1].transpose()) * t.R_AB.transpose();
  t.moments[1].noalias() = (t.Z[0] * T_).transpose() * t.R_AB;
  return t;
}

void BeamInertia::add_force(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Turning t = turning(state);
  for (std::size_t i = 0; i < 2; ++i) {
    const Matrix3& R = t.node[i]->R;
    const Vector3 moved = t.Z[i] * s_[0][i], other = t.Z[i] * s_[1][i];
    r.segment<3>(first_row(0)) += m_[0][i] * t.pull[i] + R * moved;
    r.segment<3>(first_row(1)) += m_[1][i] * t.pull[i] + R * other;
    r.segment<3>(first_row(i) + 3) += axial(t.moments[i]) + s_[0][i].cross(R.transpose() * t.pull[0]) +
                                      s_[1][i].cross(R.transpose() * t.pull[1]) + J_[i][0] * t.node[0]->Omegadot +
                                      J_[i][1] * t.node[1]->Omegadot +
                                      t.node[i]->Omega.cross(J_[i][0] * t.node[0]->Omega + J_[i][1] * t.node[1]->Omega);
  }
}

// clang-format off
// Each point moves by sum_k (N_k dx_k + A_k dTheta_k), A_k = -R_k a_k~; with its inertia force f the blocks (i,j) are
//          dx_j       dTheta_j
//   M = w [ N_i N_j I   N_i A_j   ]    C = w [ 0  N_i V_j   ]    K = w [ 0  N_i W_j   ]
//         [ N_j A_i^T   A_i^T A_j ]          [ 0  A_i^T V_j ]          [ 0  A_i^T W_j ],   and a_i~ (R_i^T f)~ in (Theta_i, Theta_i)
//   V_k = -R_k ((Omega_k~ a_k)~ + Omega_k~ a_k~),   W_k = -R_k (Z_k a_k)~;
// rotary inertia, with p_k = sum_l J_kl Omega_l:   M = J_kl,   C = Omega_k~ J_kl - delta_kl p_k~.
// The sums over the points follow from those of w N_i N_j and w N_i a_j. The terms with a_i~ .. a_i~ are rotary inertia
// of node i, except for a_i~ (R_i^T f)~ of the other forces f. Between the nodes, of w a_i a_j^T: with R_ij = R_i^T R_j,
// Q(B) = sum w a_i~ B a_j~,   (Omega~ a)~ = Omega~ a~ - a~ Omega~,   (Z a)~ = tr(Z) a~ - Z^T a~ - a~ Z,
// a~ h~ = h a^T - (a.h) 1:
//   sum w A_i^T A_j = -Q(R_ij),   sum w A_i^T V_j = -2 Q(R_ij Omega_j~) + Q(R_ij) Omega_j~,
//   sum w A_i^T W_j = -tr(Z_j) Q(R_ij) + Q(R_ij Z_j^T) + Q(R_ij) Z_j
// clang-format on
void BeamInertia::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const Turning t = turning(state);
  auto K = tangent.K.dense(), C = tangent.C.dense(), M = tangent.M.dense();
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t other = 1 - i;
    const Eigen::Index Theta_i = first_row(i) + 3, Theta_other = first_row(other) + 3;
    const Matrix3 &R_i = t.node[i]->R, &Z_i = t.Z[i], Omega_i = skew(t.node[i]->Omega);
    // Columns of Theta_i: forces of both nodes, and moment of the other.
    const Matrix3 T = i == 1 ? T_ : T_.transpose(), R = i == 1 ? t.R_AB : t.R_AB.transpose(), Q = skewed(T, R);
    for (std::size_t j = 0; j < 2; ++j) {
      const Eigen::Index x_j = first_row(j);
      const Matrix3 s = skew(s_[j][i]);
      if (tangent.wants_M) {
        const Matrix3 arm = R_i * s;
        M.block<3, 3>(first_row(i), x_j).diagonal().array() += m_[i][j];
        M.block<3, 3>(x_j, Theta_i) -= arm;
        M.block<3, 3>(Theta_i, x_j) -= arm.transpose();
        M.block<3, 3>(Theta_i, first_row(j) + 3) += J_[i][j];
      }
      if (tangent.wants_C) {
        const Matrix3 turns = 2 * Omega_i * s - s * Omega_i;
        C.block<3, 3>(x_j, Theta_i).noalias() -= R_i * turns;
        C.block<3, 3>(Theta_i, first_row(j) + 3).noalias() += Omega_i * J_[i][j];
      }
      if (tangent.wants_K) K.block<3, 3>(x_j, Theta_i).noalias() -= R_i * skew(Z_i * s_[j][i]);
    }
    if (tangent.wants_M) M.block<3, 3>(Theta_other, Theta_i) -= Q;
    if (tangent.wants_C) {
      C.block<3, 3>(Theta_other, Theta_i) += Q * Omega_i - 2 * skewed(T, R * Omega_i);
      C.block<3, 3>(Theta_i, Theta_i) -= skew(J_[i][0] * t.node[0]->Omega + J_[i][1] * t.node[1]->Omega);
    }
    if (!tangent.wants_K) continue;
    K.block<3, 3>(Theta_other, Theta_i) += Q * Z_i - Z_i.trace() * Q + skewed(T, R * Z_i.transpose());
    const Matrix3 moments = t.moments[i] + s_[0][i] * (R_i.transpose() * t.pull[0]).transpose() +
                            s_[1][i] * (R_i.transpose() * t.pull[1]).transpose();
    K.block<3, 3>(Theta_i, Theta_i) += moments.transpose();
    K.block<3, 3>(Theta_i, Theta_i).diagonal().array() -= moments.trace();
  }
}

void BeamInertia::add_energy(const LocalState& state, Energy& energy) const {
  const std::array<const NodeState*, 2> node = {&state.node(0), &state.node(1)};
  const Vector3& g = state.environment().gravity;
  for (std::size_t j = 0; j < 2; ++j) {
    const NodeState& n = *node[j];
    energy.gravity -= (m_[0][j] + m_[1][j]) * g.dot(n.x) + g.dot(n.R * (s_[0][j] + s_[1][j]));
    for (std::size_t i = 0; i < 2; ++i)
      energy.kinetic += node[i]->v.dot(0.5 * m_[i][j] * n.v + n.R * n.Omega.cross(s_[i][j])) +
                        0.5 * node[i]->Omega.dot(J_[i][j] * n.Omega);
  }
  energy.kinetic -= node[0]->Omega.dot(skewed(T_, node[0]->R.transpose() * node[1]->R) * node[1]->Omega);
}

}  // namespace bielle::mechanism
