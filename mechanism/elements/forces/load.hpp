// Force and moment on a node.
//
//   dead (default)  F, m inertial:    residual  -[ F ;  c~ R^T F + R^T m ]
//   follower        F, m node axes:   residual  -[ R F ;  c~ F + m ]
// c is the point of application in the node's axes. A dead moment of constant direction has no potential: its tangent
// is unsymmetric. Loads are multiplied by the environment's load factor.
#pragma once

#include <string>

#include "mechanism/elements/forces/force_formulas.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// A force [N] and a moment [N m], formulas of time and measures, at a point of a node, with directions fixed in space
/// or on the node. Its power is counted as input.
class Load : public Component, public TimeDependent {
 public:
  /// @param at        point of application [m], node axes
  /// @param follower  whether components are along the node's axes instead of the inertial ones
  Load(std::string name, int node, const Vector3& at, bool follower);
  /// Reads the components, after the model has been read: three formulas each. @param moment  whether they are those of
  /// the moment
  void read(const YamlValue& components, bool moment, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;
  /// Outputs `force` (3) [N] at the point of application and `moment` (3) [N m], inertial components.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  std::vector<Formula> time_formulas() const override { return formulas_.time_formulas(); }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    formulas_.calc_time_formulas(state, values);
  }

 private:
  /// Returns the generalised direction of a component of the force or moment: its contribution to the residual per
  /// unit.
  Vector6 direction(const LocalState& state, std::size_t component) const;

  int node_;
  ForceFormulas formulas_;
  References references_;
  Vector3 c_;
  bool follower_;
};

const KeyTable& load_keys();
/// Reads `{node, force, moment, at, follower}`.
void read_load(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
