// Aerodynamic forces on a beam by quasi-steady strip theory.
//
// At each point of the beam the air moves with u = S^T (wind - v) relative to the section, v the velocity of the node
// line, S the section's axes. In the section's plane, with e_c from the leading to the trailing edge (from the y axis
// by the angle `twist` about x), e_n = e_x x e_c, U = |u| there and the angle of attack alpha = atan2(u . e_n, u .
// e_c), the force and the moment about the node line per length are
//     f = rho c U/2 [ cd(alpha) u + cl(alpha) e_x x u ],     m = -rho c^2 U^2/2 cm(alpha) e_x + p x f,
// p the quarter-chord point of the section, at which the forces act (`at`). A positive cm turns the leading edge
// towards e_n. A section that turns about x at the rate Omega (pitch) is a cambered one to the air: by thin-airfoil
// theory in quasi-steady flow the angle of attack is that at the three-quarter-chord point, so that u above is
//     u = S^T (wind - v) - Omega e_x x (p + c/2 e_c),    and the moment about p has the further term  -pi/16 rho c^3 U
//     Omega e_x.
// `pitch_rate: false` omits both. The flow along the beam, the inertia of the air (which is of the same order if the
// angle of attack itself changes: Theodorsen's terms in the acceleration of the section), the wake's delay and induced
// velocities are left out.
//
// Loads are multiplied by the environment's load factor; their power is counted as input.
// References: W. Johnson, Helicopter Theory, 1980, ch. 2; Y. C. Fung, An Introduction to the Theory of Aeroelasticity,
// 1955, section 6.10.
#pragma once

#include <string>
#include <vector>

#include "mechanism/elements/beam/airfoil_polars.hpp"
#include "mechanism/elements/beam/formula_vector.hpp"
#include "mechanism/elements/beam/span_load.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Data of an airfoil; the formulas of s are 0 .. 1 along the beam.
struct Airfoil {
  double density = 1.225;        ///< rho [kg/m^3]
  FormulaVector wind;            ///< velocity of the air, inertial, of s and t [m/s]
  Expression chord, twist;       ///< c [m], twist [rad], of s
  AirfoilPolars polars;          ///< cl, cd, cm of alpha and s
  Vector3 at = Vector3::Zero();  ///< (0, y, z): p [m]
  bool pitch_rate = true;        ///< with the terms of Omega
};

const KeyTable& airfoil_keys();
/// @throws InputError
Airfoil read_airfoil(const YamlValue& value);

/// The airfoil of one element of a beam.
class AirfoilLoad final : public SpanLoad {
 public:
  /// @param name  name of the beam
  AirfoilLoad(std::string name, const BeamSpan& span, Airfoil airfoil);

  void declare(Declaration& declaration) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_break_points(std::vector<double>& times) const override;
  /// The formulas of time are evaluated in the middle of the element.
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;
  void describe(const LocalState& state, Description& description) const override;

 protected:
  SpanForce load(const LocalState& state, const SpanPoint& point, const SpanSection& at) const override;

 private:
  /// Force and moment in section axes, with derivatives by the air's velocity relative to the node line and by Omega.
  struct Strip {
    Vector3 u, F, M;
    Matrix3 F_by_u, M_by_u;
    Vector3 F_by_twist, M_by_twist;
  };
  /// @param twist_rate  Omega [rad/s]
  Strip strip(const LocalState& state, const SpanPoint& point, const SpanSection& at, double twist_rate) const;

  Airfoil airfoil_;
};

}  // namespace bielle::mechanism
