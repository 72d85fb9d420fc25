// Lower pairs: two bodies in surface contact. Each type is defined by the locked relative translations and rotations.
//
//   type         locked translations   locked rotations   coordinates
//   rigid        x y z                 all                -
//   hinge        x y z                 about x and y      angle
//   prismatic    x y                   all                displacement (along z)
//   cylindrical  x y                   about x and y      displacement, angle
//   spherical    x y z                 none               rx, ry, rz
//   planar       z                     about x and y      x, y, angle
//
// Constraint rows, with the joint's axes x_A y_A z_A on the first node and x_B y_B z_B on the second, and the
// attachment points p_A and p_B:  x_A . (p_B - p_A) = 0, with similar rows for y, z;  about x and y: x_A . z_B = 0, y_A
// . z_B = 0; all: also x_A . y_B = 0. Multipliers are the constraint forces along the joint's axes [N] and moments [N
// m]. If all three translations are locked and no row can become redundant (Slots::carried_axes), their rows are
// written in inertial axes, p_B - p_A = 0: the forces are the same, and the two nodes are only coupled by multipliers.
// Reference: A. Cardona, M. Geradin, D. B. Doan, CMAME 89 (1991) 395; Geradin and Cardona (2001) ch. 7.
#pragma once

#include "mechanism/joints/joint.hpp"
#include "mechanism/model/assembly_branch.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// The relative motions that a lower pair locks.
struct LockedMotions {
  std::array<bool, 3> translation{};                                  ///< along x, y, z of the joint's frame
  enum class Rotation { none, tilt, all } rotation = Rotation::none;  ///< tilt: about x and y
};

class LowerPair final : public Joint, public AssemblyBranch {
 public:
  LowerPair(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
            const LockedMotions& locked, const Model& model);

  void declare(Declaration& declaration) const override;
  void draw(Drawing& drawing) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  std::string wrong_branch(const LocalState& state) const override;
  Vector3 misalignment(const LocalState& state) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;

 private:
  struct Row {
    bool is_translation;
    int first_axis;   ///< axis of the joint's frame on the first node
    int second_axis;  ///< axis on the second node (rotations)
    const char* name;
  };
  PairMeasure calc_row(const Row& row, const NodeState& first, const NodeState& second) const;
  /// Tells whether the rows of locked translations are written in inertial axes.
  bool inertial(const LocalState& state) const { return inertial(state.slots()); }
  bool inertial(const Slots& slots) const { return locks_point_ && !slots.carried_axes; }
  /// Tells whether second derivatives couple the rotations of the two nodes. Those of all rows do, except for a point
  /// in inertial axes.
  bool couples_rotations(const Slots& slots) const { return !inertial(slots) || rows_.size() > 3; }
  /// @param R_12  must outlive the pair
  AxisPair axes(const Row& row, const Matrix3& R_12) const;
  std::vector<Row> rows_;
  bool locks_point_;  ///< all three translations are locked, and are the first rows
};

const KeyTable& rigid_keys();
void read_rigid(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& hinge_keys();
void read_hinge(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& prismatic_keys();
void read_prismatic(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& cylindrical_keys();
void read_cylindrical(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& spherical_keys();
void read_spherical(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& planar_keys();
void read_planar(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
