// An elastic hinge: radial, axial and tilting stiffness about an axis about which it rotates freely, over any number of
// turns.
//
// The axis z is fixed on the first node (the housing). Measures:
//     x, y    radial displacement of the second attachment point, along the housing's axes
//     z       axial displacement
//     tilt_x, tilt_y   the smallest rotation vector from the housing's z to the shaft's, along the housing's x,
//     y:
//             with the shaft's z in the housing's axes n,  tau = theta/sin(theta) [-n_y, n_x],  cos(theta) = n_z
// None of them depends on the shaft's angle. Forces have a potential; tilts stay below half a turn. The free coordinate
// is `angle`, about z.
#pragma once

#include "mechanism/joints/flexible/elastic_pair.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Bearing final : public ElasticPair {
 public:
  Bearing(std::string name, JointFrames frames, const Model& model);
  /// Checks the tilt and stores it. @throws ComputationError for nearly half a turn or more
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;

 private:
  void calc_measures(const LocalState& state, ElasticLaw::Measures& measures, bool second) const override;
};

const KeyTable& bearing_keys();
/// Reads `{type: bearing, nodes, position | at, axis, second_axis, radial, axial, tilting}`.
void read_bearing(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
