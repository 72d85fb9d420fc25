// Loads per length on an element of a beam: integration points, the section at each of them, and the forces at the
// nodes.
//
// At z in [0, 1] of an element between nodes A and B (section axes S_k = R_k R_Sk, psi = log(S_A^T S_B), length L of
// the reference) the load acts on the line and on the section
//     x(z) = (1-z) x_A + z x_B + z (1-z) L (S_A e_x - S_B e_x)/2,     S(z) = S_A exp(z psi)
//     dx = sum_k (N_k dx_k - R_k a_k~ dTheta_k),    dTheta(z) = sum_k W_k R_Sk^T dTheta_k
//     W_B = z T(z psi) T^-1(psi),   W_A similarly with 1-z and -psi.
// The line is that of the element's inertia (beam_inertia.hpp). A force f (inertial) and a moment n about the line
// (section axes) per length add the residual  -L int [ N_k f ;  a_k~ R_k^T f + R_Sk W_k^T n ]_k dz.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/math/se3.hpp"
#include "mechanism/model/component.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

using Vector12 = Eigen::Matrix<double, 12, 1>;

/// One element of a beam: its nodes and position.
struct BeamSpan {
  int node_a = 0, node_b = 0;
  Matrix3 R_A = Matrix3::Identity(), R_B = Matrix3::Identity();  ///< section frames in the axes of the nodes
  Vector3 chord = Vector3::UnitX();                              ///< its length [m] along x of the section axes
  double s_A = 0, s_B = 1;                                       ///< its ends along the beam, 0 .. 1
  const Matrix3& section_frame(std::size_t end) const { return end == 0 ? R_A : R_B; }
};

/// A point of the integral over an element.
struct SpanPoint {
  double w, z;               ///< fraction of the length [m], position in the element
  std::array<double, 2> N;   ///< shape functions
  std::array<Vector3, 2> a;  ///< [m], node axes
  double along(const BeamSpan& span) const { return span.s_A + z * (span.s_B - span.s_A); }  ///< 0 .. 1 of the beam
};

/// Three Gauss points in each piece of the element. @param ends  ends of the pieces, from 0 to 1
std::vector<SpanPoint> span_points(const BeamSpan& span, const std::vector<double>& ends);

/// The section at a point.
struct SpanSection {
  Vector3 psi;
  Matrix3 S;                 ///< section axes -> inertial
  std::array<Matrix3, 2> W;  ///< maps dTheta of the section frames at the ends to that of the section
};
/// @param state  its nodes 0 and 1 are those of the span
SpanSection span_section(const BeamSpan& span, const SpanPoint& point, const LocalState& state);

/// Position of the line at a point, inertial [m].
Vector3 span_position(const SpanPoint& point, const LocalState& state);
/// Velocity of the line at a point, inertial [m/s].
Vector3 span_velocity(const SpanPoint& point, const LocalState& state);
/// Angular velocity of the section, in its axes [rad/s].
Vector3 span_angular_velocity(const BeamSpan& span, const SpanSection& at, const LocalState& state);

/// Force (inertial) and moment about the line (section axes), per length.
struct SpanForce {
  Vector3 f, n;
};
/// Returns the contribution of a load at one point to the residual of both nodes.
Vector12 span_rows(const BeamSpan& span, const SpanPoint& point, const SpanSection& at, const SpanForce& load,
                   const LocalState& state);

// clang-format off
/// Adds the derivatives of the residual for  df = f_turn dTheta(z),  dn = n_turn dTheta(z).
///
/// Columns dTheta_j, with  dTheta(z) = W_j R_Sj^T dTheta_j  and  dpsi = -T^-T R_SA^T dTheta_A + T^-1 R_SB^T dTheta_B:
///   row x_i       -w N_i df
///   row Theta_i   -w [ a_i~ (R_i^T f)~ dTheta_i + a_i~ R_i^T df + R_Si (W_i^T dn + d(W_i^T n)/dpsi dpsi) ]
// clang-format on
void add_span_tangent(const BeamSpan& span, const SpanPoint& point, const SpanSection& at, const SpanForce& load,
                      const Matrix3& f_turn, const Matrix3& n_turn, const LocalState& state, Eigen::Ref<MatrixX> K);
/// Adds the derivatives for  df = f_rate dv,  dn = n_rate dv  by the velocity v of the line at the point.
void add_span_rate_tangent(const BeamSpan& span, const SpanPoint& point, const SpanSection& at, const Matrix3& f_rate,
                           const Matrix3& n_rate, const LocalState& state, LocalTangent& tangent);

/// Rate at which the section turns about its x axis [rad/s], with derivatives by rotations and by angular velocities of
/// the two nodes.
struct SpanTwistRate {
  double value = 0;
  std::array<Eigen::RowVector3d, 2> by_turn, by_rate;
};
SpanTwistRate span_twist_rate(const BeamSpan& span, const SpanPoint& point, const SpanSection& at,
                              const LocalState& state);
/// Adds the derivatives of the residual for  df = f_twist dOmega,  dn = n_twist dOmega  by this rate.
void add_span_twist_tangent(const BeamSpan& span, const SpanPoint& point, const SpanSection& at,
                            const SpanTwistRate& twist, const SpanForce& by_twist, const LocalState& state,
                            LocalTangent& tangent);

/// A load along one element of a beam, integrated over its points. Its power is counted as input.
class SpanLoad : public Component, public TimeDependent {
 public:
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const final;
  void add_energy(const LocalState& state, Energy& energy) const final;

 protected:
  /// @param beam  name of the beam @param ends  ends of the pieces of the integral, from 0 to 1
  SpanLoad(std::string beam, const BeamSpan& span, const std::vector<double>& ends);
  /// Replaces the division of the integral into pieces. @param ends  as for the constructor
  void divide(const std::vector<double>& ends) { points_ = span_points(span_, ends); }
  /// Returns force and moment per length at a point, multiplied by the load factor.
  virtual SpanForce load(const LocalState& state, const SpanPoint& point, const SpanSection& at) const = 0;
  const BeamSpan& span() const { return span_; }
  const std::vector<SpanPoint>& points() const { return points_; }

 private:
  BeamSpan span_;
  std::vector<SpanPoint> points_;
};

}  // namespace bielle::mechanism
