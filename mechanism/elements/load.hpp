// Force and moment on a node.
//
//   dead (default)  F, m inertial:    residual  -[ F ;  c~ R^T F + R^T m ]
//   follower        F, m node axes:   residual  -[ R F ;  c~ F + m ]
// c is the point of application in the node's axes. A dead moment of constant direction is no potential load: its
// tangent is unsymmetric. Loads are multiplied by the environment's load factor.
#pragma once

#include <string>

#include "mechanism/elements/formula_vector.hpp"
#include "mechanism/system/component.hpp"
#include "mechanism/system/model.hpp"

namespace bielle::mechanism {

/// A force [N] and a moment [N m] as functions of time at a point of a node, fixed in space or turning with the node.
/// Its power is counted as input.
class Load : public Component {
 public:
  /// @param force,moment  components along the inertial axes, or along the node's axes if `follower`
  /// @param at            point of application [m], node axes
  Load(std::string name, int node, FormulaVector force, FormulaVector moment, const Vector3& at, bool follower);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override;

 private:
  /// Force and moment along the axes in which they are given, with the load factor.
  void evaluate(const LocalState& state, Vector3& F, Vector3& m) const;

  int node_;
  FormulaVector force_, moment_;
  Vector3 c_;
  bool follower_;
};

/// `{node, force, moment, at, follower}`
void read_load(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
