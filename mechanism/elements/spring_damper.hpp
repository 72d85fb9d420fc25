// Spring and damper along the line between two points of two nodes.
//
// With p_k = x_k + R_k c_k, s = p_B - p_A, l = |s|, u = s/l, elongation e = l - l_0 and rate v = ldot = u . sdot, the
// tension N (positive when it pulls the points together) is
//     N = k e + c v,   or any function N(e, v, t).
// It acts on A with +N u and on B with -N u: residual J^T N u, where J = ds/dz = [-I, R_A c_A~, I, -R_B c_B~].
#pragma once

#include <optional>
#include <string>

#include "mechanism/system/component.hpp"
#include "mechanism/system/model.hpp"
#include "reduce/common/expression.hpp"

namespace bielle::mechanism {

/// The tension of a spring_damper and its partial derivatives.
struct Tension {
  double N = 0;    ///< [N]
  double N_e = 0;  ///< [N/m]
  double N_v = 0;  ///< [N s/m]
};

/// Law of a spring_damper: linear, or a formula.
class TensionLaw {
 public:
  static TensionLaw linear(double stiffness, double damping);   ///< [N/m], [N s/m]
  static TensionLaw formula(const Expression& of_e_v);          ///< N(e, v): elastic part N(e, 0), the rest dissipates
  static TensionLaw timed_formula(const Expression& of_e_v_t);  ///< N(e, v, t): counted as input

  Tension at(double e, double v, double t) const;
  bool is_linear() const { return !formula_; }
  bool is_timed() const { return timed_; }
  double damping() const { return damping_; }
  /// Energy [J] stored from 0 to e: integral of N(e, 0) de.
  double elastic_energy(double e) const;

 private:
  double stiffness_ = 0, damping_ = 0;
  std::optional<Expression> formula_;
  bool timed_ = false;
};

/// See the head of this file. The direction is undefined where the points coincide: only a linear spring of free length
/// zero without damper may pass there, any other throws ComputationError. Exact tangents.
///
/// Energies: a linear law and a formula of (e, v) store the integral of N(e, 0) and dissipate (N(e, v) - N(e, 0)) v; a
/// formula of time is an actuator, whose power -N v is counted as input.
class SpringDamper : public Component {
 public:
  /// @param at_a,at_b  attachment points [m], in the axes of their nodes
  /// @param length     free length l_0 [m]
  SpringDamper(std::string name, int node_a, int node_b, const Vector3& at_a, const Vector3& at_b, double length,
               TensionLaw law);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// `length` [m], `rate` [m/s], `force` [N], tension positive.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 private:
  struct Line;
  Line line(const LocalState& state) const;

  int node_a_, node_b_;
  Vector3 c_a_, c_b_;
  double length_;
  TensionLaw law_;
};

/// `{type: spring_damper, nodes: [a, b], at, stiffness, damping, length}` or with `force: "N(e, v, t)"` in place of
/// stiffness and damping.
void read_spring_damper(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
