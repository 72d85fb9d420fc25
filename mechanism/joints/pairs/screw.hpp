// Screw: a cylindrical joint whose displacement follows its angle,
//     x_A . d = y_A . d = 0,   x_A . z_B = y_A . z_B = 0,   z_A . d - pitch angle/(2 pi) = 0,   d from J_A to J_B.
// The pitch [m per turn] is positive for right-handed threads: the second node moves along +axis for a positive
// rotation. The angle is counted over any number of turns. The last row's multiplier is the axial force in the thread
// [N].
#pragma once

#include "mechanism/joints/measured_pair.hpp"
#include "mechanism/model/assembly_branch.hpp"

namespace bielle::mechanism {

class ScrewJoint final : public MeasuredRows<ScrewJoint>, public AssemblyBranch {
 public:
  ScrewJoint(std::string name, JointFrames frames, double pitch, const Model& model);
  void start_at(std::size_t coordinate, double value, bool by_motion = true) override;
  std::vector<SlidingSurface> sliding_surfaces() const override;  ///< the sliding surface of its thread
  std::string wrong_branch(const LocalState& state) const override;
  Vector3 misalignment(const LocalState& state) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  friend MeasuredRows;
  template <int order>
  void rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const;
  double pitch_;
};

const KeyTable& screw_keys();
/// Reads `pitch`: [m per turn].
void read_screw(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
