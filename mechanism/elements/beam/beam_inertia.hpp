// Inertia of one beam element.
//
// clang-format off
// The line of mass centres between nodes A and B, with z in [0, 1], the mass offset c and the tangents of this line at
// the ends in the reference state, g = u + psi~ c ([u; psi] is the derivative of the section frame by z), fixed in the
// section frames of A and B (R_A, R_B are here their axes), is
//     x(z) = (1-z)(x_A + R_A c) + z (x_B + R_B c) + z (1-z) (R_A g_A - R_B g_B)/2
// so that the rotations of the ends bend the line. Kinetic energy, with m and J (about the mass centre) per length:
//     T = 1/2 m L int |xdot|^2 dz                     consistent, by three Gauss points (exact for the mass matrix)
//       + 1/2 (m L/12) |ydot|^2,   y = (x_B + R_B c) - (x_A + R_A c) - (R_A g_A + R_B g_B)/2
//       + 1/2 (L/2) (Omega_A.J Omega_A + Omega_B.J Omega_B) - 1/2 (J_t L/12) (t.(Omega_A - Omega_B))^2   (section axes)
// clang-format on
// The symbols are the line's length L, the direction t of d0_u, and J_t = t.J t. The terms with 1/12 are the mean of
// consistent and lumped masses, whose errors in the frequencies of axial, shear and torsional waves, +-(k L)^2/24,
// cancel (G. Goudreau, R. Taylor, Comput. Methods Appl. Mech. Eng. 2 (1973) 69); in bending y is of third order, and
// the lumped rotary inertia is correct. With the residual bending flexibility of BeamElement, the frequencies of
// uniform beams, straight, curved, twisted, or with an offset from the node line, converge with the fourth power of L,
// except for a part E/(k_s G) (k r)^2 (k L)^2/24 in bending (wave number k, radius of gyration r, shear factor k_s):
// the line does not represent the variation of shear along it. All terms rotate with the nodes, and y is independent of
// translations: energy and momenta are conserved exactly. No term depends on the deformation. In a tapered beam m, c
// and J are those of the Gauss points; J is distributed to the ends linearly, and the terms with 1/12 use means:
// frequencies of tapered beams converge with the second power of L.
#pragma once

#include <array>
#include <functional>
#include <utility>

#include "mechanism/elements/beam/beam_section.hpp"
#include "mechanism/math/se3.hpp"
#include "mechanism/model/component.hpp"

namespace bielle::mechanism {

/// The stress-free shape of an element: by default the helix from A to B.
struct BeamReference {
  Vector6 d0;                                ///< log6(H_A^-1 H_B)
  double length;                             ///< length of the line [m]
  Vector6 rate_A, rate_B;                    ///< derivative of the section frame by z at the ends, in its axes
  std::function<Frame(double)> seen_from_B;  ///< section frame at z in [0, 1] (0 at A) in the axes of the one at B

  BeamReference(const Vector6& helix)  // NOLINT: a relative motion is a shape
      : BeamReference(helix, helix.head<3>().norm(), helix, helix,
                      [helix](double z) { return exp_se3((z - 1) * helix); }) {}
  BeamReference(const Vector6& relative, double line_length, const Vector6& start, const Vector6& end,
                std::function<Frame(double)> frames)
      : d0(relative), length(line_length), rate_A(start), rate_B(end), seen_from_B(std::move(frames)) {}
};

/// See the head of this file. Adds to the local vectors and matrices of a component whose nodes are A and B; gravity
/// included.
class BeamInertia {
 public:
  /// @param R_A,R_B  section frames in the axes of nodes A and B
  BeamInertia(const ElementSections& sections, const Matrix3& R_A, const Matrix3& R_B, const BeamReference& reference);

  bool is_massless() const { return massless_; }
  void add_force(const LocalState& state, Eigen::Ref<VectorX> r) const;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const;
  void add_energy(const LocalState& state, Energy& energy) const;

 private:
  template <class Value>
  using Pairs = std::array<std::array<Value, 2>, 2>;  ///< values for nodes (i,j)
  /// The part that depends on the rotations.
  struct Turning;
  Turning turning(const LocalState& state) const;

  // Sums over points with the mass w at sum_k (N_k x_k + R_k a_k), k = A, B, and a_k in node axes. (For y the sum of
  // N_k is zero: no weight, no momentum.)
  Pairs<double> m_{};  ///< sum w N_i N_j [kg]
  Pairs<Vector3> s_;   ///< sum w N_i a_j [kg m], axes of node j
  Matrix3 T_;          ///< sum w a_A a_B^T [kg m^2], axes of nodes A and B
  Pairs<Matrix3> J_;   ///< rotary inertia of nodes, with sum w a_i~^T a_i~, and between nodes [kg m^2], node axes
  bool massless_;
};

}  // namespace bielle::mechanism
