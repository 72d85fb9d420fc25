// A quantity of a gear mesh that depends on the angles of its wheels, such as the stiffness of the teeth or the error
// of their flanks.
//
// It is a sum of terms f(phi), each a function of the angle phi of one wheel relative to the carrier [rad, zero as
// drawn, counted over turns]: a formula, or a table over one of `teeth` equal parts of a turn, which a periodic cubic
// spline joins,
//     f(phi) = spline(teeth phi/(2 pi) + phase),   of period 1;
// and of terms f(phi_1, phi_2), formulas of the angles of both wheels.
// The spline has a continuous second derivative: forces derived from a potential that contains f are smooth.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "mechanism/joints/gears/tooth_contact.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/formula/expression.hpp"
#include "reduce/common/formula/interpolation.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class MeshFunction {
 public:
  MeshFunction() = default;  ///< the constant 0
  explicit MeshFunction(double constant) : constant_(constant) {}
  /// @param wheel  0 or 1
  void add(Expression formula, int wheel) { terms_.push_back({wheel, std::move(formula), {}, 1, 0}); }
  /// @param formula  formula of the angles of both wheels
  void add_of_both(Expression formula) { of_both_.push_back(std::move(formula)); }
  /// @param curve  periodic, with the period 1
  void add(Interpolation curve, int wheel, double teeth, double phase) {
    terms_.push_back({wheel, {}, std::move(curve), teeth, phase});
  }

  /// Tells whether the function depends on the angles.
  bool varies() const { return !terms_.empty() || !of_both_.empty(); }
  bool is_zero() const { return !varies() && constant_ == 0; }
  /// Computes the function with its derivatives. @param contact,state  contact and state of the mesh, which give the
  /// angles
  template <int order>
  MeshMeasureOf<order> calc(const ToothContact& contact, const LocalState& state) const;
  /// Computes the value at given angles.
  double value(const std::array<double, 2>& angle) const;

 private:
  struct Term {
    int wheel;
    Expression formula;
    std::optional<Interpolation> curve;
    double teeth, phase;
    /// Returns value, slope and curvature at an angle.
    Interpolation::Values at(double angle) const;
  };
  double constant_ = 0;
  std::vector<Term> terms_;
  std::vector<Expression> of_both_;
};

/// Returns the forms of `errors`.
KeyForms tooth_error_forms();
/// Reads `errors`: a formula of phi and phi_2, or one or several of {table or formula, wheel, teeth, phase}. @throws
/// InputError
MeshFunction read_tooth_errors(const YamlValue& value);

/// Returns the forms of `stiffness`.
KeyForms tooth_stiffness_forms();
/// Reads `stiffness`: a number, a formula of phi and phi_2, {table, wheel, teeth, phase} or {iso: {..}}.
/// @param geometry  geometry of the mesh  @param helix  angle of the first wheel [rad]
/// @param internal  whether one wheel is a ring
/// @throws InputError also if it is not positive everywhere
MeshFunction read_tooth_stiffness(const YamlValue& value, const ToothGeometry& geometry, double helix, bool internal);

}  // namespace bielle::mechanism
