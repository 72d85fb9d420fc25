// Force and moment between two nodes, by formulas of time and state.
//
// F and m act on the second node at its point p_2 = x_2 + R_2 c, and -F, -m on the first node at the same place: the
// pair adds no momentum and no angular momentum. Components are along the axes of the first node (default), of the
// second, or inertial ones:  F = A f, m = A mu, A = R_1, R_2 or 1.  With s = R_1^T (p_2 - x_1), F_k = R_k^T F:
//     residual   [ F ;  s x F_1 + m_1 ;  -F ;  -c x F_2 - m_2 ].
// Its power is counted as input.
#pragma once

#include <array>

#include "mechanism/elements/forces/force_formulas.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class NodeForce final : public Component, public TimeDependent {
 public:
  enum class Axes { first, second, inertial };
  /// @param at  point of application [m], in the axes of the second node
  NodeForce(std::string name, std::array<int, 2> nodes, const Vector3& at, Axes axes);
  /// Reads the components, after the model has been read. @param moment  whether they are those of the moment
  void read(const YamlValue& components, bool moment, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override;
  /// Outputs `force` [N] and `moment` [N m] on the second node, inertial components.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;
  std::vector<Formula> time_formulas() const override { return formulas_.time_formulas(); }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    formulas_.calc_time_formulas(state, values);
  }

 private:
  using Map12 = Eigen::Matrix<double, 12, 3>;
  Matrix3 axes(const LocalState& state) const;  ///< the axes A
  /// Matrices that map inertial components of the force, and of the moment, to the residual.
  Map12 of_force(const LocalState& state) const;
  static Map12 of_moment(const LocalState& state);
  std::array<int, 2> nodes_;
  Vector3 c_;
  Axes axes_;
  ForceFormulas formulas_;  ///< formulas of f and mu
  References references_;
};

const KeyTable& node_force_keys();
/// Reads `{nodes, force, moment, at, axes: first | second | inertial}`.
void read_node_force(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
