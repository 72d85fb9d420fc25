// Spring and damper along the line between two points of two nodes.
//
// With p_k = x_k + R_k c_k, s = p_B - p_A, l = |s|, u = s/l, elongation e = l - l_0 and rate v = ldot = u . sdot, the
// tension N (positive when it pulls the points together) is
//     N = k e + c v,   or any function N(e, v, t, measures).
// It acts on A with +N u and on B with -N u: residual J^T N u, where J = ds/dz = [-I, R_A c_A~, I, -R_B c_B~].
#pragma once

#include <string>
#include <utility>

#include "mechanism/laws/force_law.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// See the head of this file. The direction is undefined if the points coincide: coinciding points are only permitted
/// for a linear spring of free length zero without damper; otherwise a ComputationError is thrown. The tangents are
/// exact.
///
/// For energies see laws/force_law.hpp.
class SpringDamper : public Component, public TimeDependent {
 public:
  /// @param at_a,at_b  attachment points [m], in the axes of their nodes
  /// @param length     free length l_0 [m]
  SpringDamper(std::string name, int node_a, int node_b, const Vector3& at_a, const Vector3& at_b, double length,
               ForceLaw law);
  /// Adds a formula of e, v, t and measures to the tension, after the model has been read.
  void read(const YamlValue& formula, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Outputs `length` [m], `rate` [m/s], `force` [N], tension positive.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void add_break_points(std::vector<double>& times) const override { law_.add_break_points(times); }
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;
  std::vector<std::string> measure_names() const override { return {"elongation", "elongation.rate", "force"}; }
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

  /// Returns the elongation [m] and its rate [m/s].
  std::pair<double, double> elongation(const LocalState& state) const;
  /// Gradients of elongation and rate over the twelve unknowns of the nodes by positions; the gradient of the rate by
  /// velocities equals that of the elongation by positions.
  struct Gradients {
    double e, v;
    Eigen::Matrix<double, 12, 1> e_gradient, v_gradient;
  };
  Gradients calc_elongation(const LocalState& state) const;
  /// Returns the tension [N], positive when it pulls the points together.
  double force(const LocalState& state) const;
  /// Computes the tension with its derivatives by elongation and rate.
  /// @throws ComputationError if it is a formula of measures, whose derivatives are not among those of the spring
  LawForce calc_force(const LocalState& state) const;

 private:
  struct Line;
  Line line(const LocalState& state) const;     ///< does not compute the tension
  Vector3 span(const LocalState& state) const;  ///< vector from the first attachment point to the second, inertial
  double smallest_length(const LocalState& state) const;

  int node_a_, node_b_;
  Vector3 c_a_, c_b_;
  double length_;
  ForceLaw law_;
  References references_;
};

/// Reads `{type: spring_damper, nodes: [a, b], at, stiffness, damping, length}`, or the same with `force: "N(e, v, t)"`
/// instead of stiffness and damping.
const KeyTable& spring_damper_keys();
void read_spring_damper(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
