// Stretch of a beam element by its own bending (bowing).
//
// The part of the shear normal to the chord t of an element with the helix strain e that its sections do not take,
//     gamma_b = (1 - t t^T) [e - S C_e e]_u,   S: mean of C^-1, C_e: stiffness of the element,
// is an S-shaped bending of slope v' = 6 gamma_b (1/12 - z^2) at -1/2 <= z <= 1/2. The helix treats it as shear. The
// bent chord has the length r = (c^2 + gamma_b^2)^1/2, c = 1 + t . e_u, and the line is longer by gamma_b^2/(10 r):
//     q = r + G/(10 r) - c,   G = gamma_b^2 = e^T Q e,   strain eps = e + t q,   J = deps/de = 1 + t (dq/de)^T
// This makes the geometric stiffness of a straight slender element the consistent one of the cubic beam (J.
// Przemieniecki, Theory of Matrix Structural Analysis, 1968, ch. 15); without it, an element under a tension of 12
// EI/L^2 would deflect sideways. An element without stretch keeps r below one, however far it bends: with q = (3/5)
// gamma_b^2, the same for small angles, it would become longer than itself from a side load of 18 EI/L^2 on. Products
// of gamma_b with shear and stretch of the section are neglected; their effect decreases with the element length.
#pragma once

#include "mechanism/elements/beam/beam_section.hpp"
#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class BeamBowing {
 public:
  /// Makes a beam without bowing: q = 0.
  BeamBowing() = default;
  /// @param stiffness  C_e of the element
  /// @param along      t
  BeamBowing(const Matrix6& stiffness, const ElementSections& sections, const Vector3& along);

  struct Stretch {
    double G = 0, r = 1;
    Vector6 Qe = Vector6::Zero();
    Vector6 chord = Vector6::Zero();     ///< r dr/de
    double q = 0;                        ///< [1]
    Vector6 gradient = Vector6::Zero();  ///< dq/de
  };
  Stretch at(const Vector6& e) const;
  Matrix6 second_gradient(const Stretch& stretch) const;  ///< d2q/de2

 private:
  bool bows_ = false;
  Matrix6 Q_ = Matrix6::Zero();
  Vector3 along_ = Vector3::Zero();
};

}  // namespace bielle::mechanism
