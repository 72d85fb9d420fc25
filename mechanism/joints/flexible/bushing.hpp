// A block of rubber, a flexible coupling, or a mount between two nodes: six stiffnesses with full coupling, damping,
// curves and hysteresis, without a constraint.
//
// Its measures x, y, z, rx, ry, rz are those of the frame halfway between the two nodes (measures/middle_frame.hpp):
// displacement of the second attachment point along its axes, and the rotation vector of the second frame relative to
// the first. Forces follow the law of laws/elastic_law.hpp in these measures. Therefore
// - a rigid motion of both nodes has no effect, for any rotation;
// - exchanging the nodes only changes the signs;
// - the elastic force has a potential, and its tangent is symmetric in equilibrium, at any relative rotation below half
//   a turn. The moment about the axes of the frame is T^-T(psi) of that along psi: the two agree for small rotations.
#pragma once

#include "mechanism/joints/flexible/elastic_pair.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Bushing final : public ElasticPair {
 public:
  Bushing(std::string name, JointFrames frames, const Model& model);
  /// Checks the rotation vector and stores it. @throws ComputationError for nearly half a turn or more
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;

 private:
  void calc_measures(const LocalState& state, ElasticLaw::Measures& measures, bool second) const override;
};

const KeyTable& bushing_keys();
/// Reads `{type: bushing, nodes, position | at, axis, second_axis, stiffness, damping, preload, curves, maxwell}`.
void read_bushing(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
