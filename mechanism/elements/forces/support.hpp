// The support of a node: its force and moment.
//
// Directions that are fixed or prescribed are eliminated; the support forces follow from the equilibrium of the node
// afterwards. The residuals of all components on the node, and on nodes that it carries rigidly (inertia + internal -
// external forces, reactions of joints), are summed: the support exerts their sum. Along free directions the sum is
// zero.
#pragma once

#include "mechanism/model/model.hpp"
#include "mechanism/model/sought_effort.hpp"

namespace bielle::mechanism {

/// The component adds nothing to the equations; it records `/supports/<node>/reaction`.
class Support final : public Component, public NodeSupport {
 public:
  /// @param node    supported node   @param carried  nodes that it carries
  /// @param acting  components that have rows on one of them, directly or through references
  Support(std::string name, int node, std::vector<int> carried, std::vector<const Component*> acting);
  int node() const override { return node_; }
  Vector6 reaction(const LocalState& state) const override;

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& /*state*/, Eigen::Ref<VectorX> /*r*/) const override {}
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 private:
  /// Adds the rows of the held and carried nodes of a local vector to the sum.
  void gather(const State& state, const Slots& slots, const Eigen::Ref<const VectorX>& r, int begin,
              Vector6& sum) const;
  int node_;
  std::vector<int> carried_;
  std::vector<const Component*> acting_;
};

/// Creates a support for each node of the model that is held in some direction (except a point mass whose rotation
/// alone is held). Call it after all components have been created.
void add_supports(Model& model);

}  // namespace bielle::mechanism
