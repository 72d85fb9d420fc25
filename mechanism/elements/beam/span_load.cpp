#include "mechanism/elements/beam/span_load.hpp"

#include <utility>

#include "mechanism/math/gauss.hpp"
#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {
namespace {

/// Returns W_B, which maps a small rotation of end B to that of the section at z.
Matrix3 end_share(double z, const Vector3& psi) { return z * tangent(z * psi) * tangent_inverse(psi); }

/// Returns d(W_B^T n)/dpsi with n fixed:  W_B^T n = z T^-T(psi) p,   p = T(z psi)^T n.
Matrix3 end_share_gradient(double z, const Vector3& psi, const Vector3& n) {
  const Matrix3 T = tangent(z * psi);
  Matrix3 p_gradient;
  for (int j = 0; j < 3; ++j) p_gradient.col(j) = z * tangent_derivative(z * psi, Vector3::Unit(j)).transpose() * n;
  return z * (inverse_transpose_gradient(psi, T.transpose() * n) + tangent_inverse(psi).transpose() * p_gradient);
}

/// Returns d(W_k^T n)/dpsi of both ends with n fixed.
std::array<Matrix3, 2> share_gradients(const SpanPoint& point, const SpanSection& at, const Vector3& n) {
  return {-end_share_gradient(1 - point.z, -at.psi, n), end_share_gradient(point.z, at.psi, n)};
}

/// Returns the derivatives of psi by small rotations of the section frames at the ends.
std::array<Matrix3, 2> psi_gradients(const SpanSection& at) {
  const Matrix3 T_inverse = tangent_inverse(at.psi);
  return {-T_inverse.transpose(), T_inverse};
}

}  // namespace

std::vector<SpanPoint> span_points(const BeamSpan& span, const std::vector<double>& ends) {
  std::vector<SpanPoint> points;
  const double L = span.chord.norm();
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    for (std::size_t g = 0; g < 3; ++g) {
      const double part = ends[k + 1] - ends[k], z = ends[k] + part * Gauss3::place[g];
      const Vector3 bubble = 0.5 * z * (1 - z) * span.chord;
      points.push_back({L * part * Gauss3::weight[g], z, {1 - z, z}, {span.R_A * bubble, -(span.R_B * bubble)}});
    }
  return points;
}

SpanSection span_section(const BeamSpan& span, const SpanPoint& point, const LocalState& state) {
  SpanSection at;
  const Matrix3 S_A = state.node(0).R * span.R_A, S_B = state.node(1).R * span.R_B;
  at.psi = log_so3(S_A.transpose() * S_B);
  at.S = S_A * exp_so3(point.z * at.psi);
  at.W = {end_share(1 - point.z, -at.psi), end_share(point.z, at.psi)};
  return at;
}

Vector3 span_position(const SpanPoint& point, const LocalState& state) {
  Vector3 x = Vector3::Zero();
  for (int k = 0; k < 2; ++k) {
    const auto i = static_cast<std::size_t>(k);
    x += point.N[i] * state.node(k).x + state.node(k).R * point.a[i];
  }
  return x;
}

Vector3 span_velocity(const SpanPoint& point, const LocalState& state) {
  Vector3 v = Vector3::Zero();
  for (std::size_t k = 0; k < 2; ++k) {
    const NodeState& node = state.node(static_cast<int>(k));
    v += point.N[k] * node.v + node.R * node.Omega.cross(point.a[k]);
  }
  return v;
}

Vector3 span_angular_velocity(const BeamSpan& span, const SpanSection& at, const LocalState& state) {
  Vector3 Omega = Vector3::Zero();
  for (std::size_t k = 0; k < 2; ++k)
    Omega += at.W[k] * span.section_frame(k).transpose() * state.node(static_cast<int>(k)).Omega;
  return Omega;
}

Vector12 span_rows(const BeamSpan& span, const SpanPoint& point, const SpanSection& at, const SpanForce& load,
                   const LocalState& state) {
  Vector12 rows;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto x = static_cast<Eigen::Index>(6 * k);
    rows.segment<3>(x) = -point.w * point.N[k] * load.f;
    rows.segment<3>(x + 3) = -point.w * (point.a[k].cross(state.node(static_cast<int>(k)).R.transpose() * load.f) +
                                         span.section_frame(k) * at.W[k].transpose() * load.n);
  }
  return rows;
}

void add_span_tangent(const BeamSpan& span, const SpanPoint& point, const SpanSection& at, const SpanForce& load,
                      const Matrix3& f_turn, const Matrix3& n_turn, const LocalState& state, Eigen::Ref<MatrixX> K) {
  const std::array<Matrix3, 2> psi_gradient = psi_gradients(at), W_gradient = share_gradients(point, at, load.n);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto x_i = static_cast<Eigen::Index>(6 * i), Theta_i = x_i + 3;
    const Matrix3& R_i = state.node(static_cast<int>(i)).R;
    const Matrix3 a_i = skew(point.a[i]);
    for (std::size_t j = 0; j < 2; ++j) {
      const auto Theta_j = static_cast<Eigen::Index>(6 * j + 3);
      const Matrix3 to_end = span.section_frame(j).transpose(), section_turn = at.W[j] * to_end;
      K.block<3, 3>(x_i, Theta_j) -= point.w * point.N[i] * f_turn * section_turn;
      K.block<3, 3>(Theta_i, Theta_j) -=
          point.w *
          (a_i * R_i.transpose() * f_turn * section_turn +
           span.section_frame(i) * (at.W[i].transpose() * n_turn * at.W[j] + W_gradient[i] * psi_gradient[j]) * to_end);
    }
    K.block<3, 3>(Theta_i, Theta_i) -= point.w * a_i * skew(R_i.transpose() * load.f);
  }
}

void add_span_rate_tangent(const BeamSpan& span, const SpanPoint& point, const SpanSection& at, const Matrix3& f_rate,
                           const Matrix3& n_rate, const LocalState& state, LocalTangent& tangent) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto x_i = static_cast<Eigen::Index>(6 * i);
    const Matrix3& R_i = state.node(static_cast<int>(i)).R;
    Eigen::Matrix<double, 6, 3> by_velocity;
    by_velocity.topRows<3>() = -point.w * point.N[i] * f_rate;
    by_velocity.bottomRows<3>() =
        -point.w * (skew(point.a[i]) * R_i.transpose() * f_rate + span.section_frame(i) * at.W[i].transpose() * n_rate);
    for (std::size_t j = 0; j < 2; ++j) {
      const auto x_j = static_cast<Eigen::Index>(6 * j);
      const NodeState& node = state.node(static_cast<int>(j));
      // dv = N dv_j + R_j [ dTheta_j~ (Omega_j x a_j) + dOmega_j x a_j ]
      if (tangent.wants_K)
        tangent.K.dense().block<6, 3>(x_i, x_j + 3) -= by_velocity * node.R * skew(node.Omega.cross(point.a[j]));
      if (!tangent.wants_C) continue;
      tangent.C.dense().block<6, 3>(x_i, x_j) += point.N[j] * by_velocity;
      tangent.C.dense().block<6, 3>(x_i, x_j + 3) -= by_velocity * node.R * skew(point.a[j]);
    }
  }
}

// With n_k = W_k^T e_x(psi), the rate is the sum of n_k . R_Sk^T Omega_k.
SpanTwistRate span_twist_rate(const BeamSpan& span, const SpanPoint& point, const SpanSection& at,
                              const LocalState& state) {
  const std::array<Matrix3, 2> psi_gradient = psi_gradients(at), share = share_gradients(point, at, Vector3::UnitX());
  SpanTwistRate twist;
  Eigen::RowVector3d by_psi = Eigen::RowVector3d::Zero();
  for (std::size_t k = 0; k < 2; ++k) {
    const Matrix3 to_end = span.section_frame(k).transpose();
    const Vector3 omega = to_end * state.node(static_cast<int>(k)).Omega;
    twist.by_rate[k] = at.W[k].row(0) * to_end;
    twist.value += at.W[k].row(0).dot(omega);
    by_psi += omega.transpose() * share[k];
  }
  for (std::size_t k = 0; k < 2; ++k) twist.by_turn[k] = by_psi * psi_gradient[k] * span.section_frame(k).transpose();
  return twist;
}

void add_span_twist_tangent(const BeamSpan& span, const SpanPoint& point, const SpanSection& at,
                            const SpanTwistRate& twist, const SpanForce& by_twist, const LocalState& state,
                            LocalTangent& tangent) {
  const Vector12 rows = span_rows(span, point, at, by_twist, state);
  for (std::size_t j = 0; j < 2; ++j) {
    const auto Theta_j = static_cast<Eigen::Index>(6 * j + 3);
    if (tangent.wants_K) tangent.K.dense().block<12, 3>(0, Theta_j) += rows * twist.by_turn[j];
    if (tangent.wants_C) tangent.C.dense().block<12, 3>(0, Theta_j) += rows * twist.by_rate[j];
  }
}

SpanLoad::SpanLoad(std::string beam, const BeamSpan& span, const std::vector<double>& ends)
    : Component("beam", std::move(beam)), span_(span), points_(span_points(span, ends)) {}

void SpanLoad::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  for (const SpanPoint& point : points_) {
    const SpanSection at = span_section(span_, point, state);
    r.head<12>() += span_rows(span_, point, at, load(state, point, at), state);
  }
}

void SpanLoad::add_energy(const LocalState& state, Energy& energy) const {
  for (const SpanPoint& point : points_) {
    const SpanSection at = span_section(span_, point, state);
    const SpanForce here = load(state, point, at);
    energy.input +=
        point.w * (here.f.dot(span_velocity(point, state)) + here.n.dot(span_angular_velocity(span_, at, state)));
  }
}

}  // namespace bielle::mechanism
