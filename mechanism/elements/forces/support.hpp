// What holds a node: the force and moment of its support.
//
// Nodes that are fixed or moved along a prescribed way are eliminated; what the support does follows from the
// equilibrium of the node afterwards. Of all that acts on the node, and on nodes that it carries rigidly, the residuals
// (inertia + internal - external forces, reactions of joints) are added up: the support exerts their sum. Along
// directions that are free the sum is zero.
#pragma once

#include "mechanism/model/model.hpp"
#include "mechanism/model/sought_effort.hpp"

namespace bielle::mechanism {

/// Adds nothing to the equations; records `/supports/<node>/reaction`.
class Support final : public Component, public NodeSupport {
 public:
  /// @param node    that is held   @param carried  nodes that it carries
  /// @param acting  whatever has rows on one of them, in itself or in what it refers to
  Support(std::string name, int node, std::vector<int> carried, std::vector<const Component*> acting);
  int node() const override { return node_; }
  Vector6 reaction(const LocalState& state) const override;

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& /*state*/, Eigen::Ref<VectorX> /*r*/) const override {}
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 private:
  /// Adds the rows of the held and carried nodes in a local vector.
  void gather(const State& state, const Slots& slots, const Eigen::Ref<const VectorX>& r, int begin,
              Vector6& sum) const;
  int node_;
  std::vector<int> carried_;
  std::vector<const Component*> acting_;
};

/// Makes one of each node of the model that is held in some direction (but of a point mass that is held against turning
/// alone). Call when all components are there.
void add_supports(Model& model);

}  // namespace bielle::mechanism
