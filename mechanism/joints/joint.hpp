// A joint between two nodes: its frames, its coordinates, and its records. What a type constrains is its own file's
// matter.
//
// The joint's frame J_A rides on the first node, J_B on the second; both coincide in the positions written in the input
// file. z is the joint's `axis`, x its `second_axis` (made orthogonal) or chosen. Coordinates are zero there; angles
// are counted over any number of turns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/joints/measure.hpp"
#include "mechanism/system/model.hpp"

namespace bielle::mechanism {

/// What a coordinate is: a displacement along an axis of the joint's frame, an angle about its z axis, or a component
/// of the rotation vector of J_B beside J_A (principal value; its rate is the relative angular velocity).
struct JointCoordinate {
  enum class Kind { displacement, angle, rotation };
  std::string name;  ///< "angle", "displacement", "x", ...
  Kind kind = Kind::displacement;
  int axis = 2;  ///< 0 x, 1 y, 2 z
  const char* units() const { return kind == Kind::displacement ? "m" : "rad"; }
};

/// Frames of a joint on its two nodes, in the nodes' axes.
struct JointFrames {
  int first = 0, second = 0;  ///< nodes of the model
  Frame on_first, on_second;
};

class Joint : public Component {
 public:
  Joint(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
        const Model& model);

  const JointFrames& frames() const { return frames_; }
  const std::vector<JointCoordinate>& coordinates() const { return coordinates_; }
  /// A displacement or angle (in (-pi, pi]) of the two nodes, with its derivatives.
  Measure calc_coordinate(std::size_t index, const NodeState& first, const NodeState& second) const;

  /// The value of an angle at the start [rad], to count turns from (a drive begins some turns away). Default 0.
  void start_at(std::size_t coordinate, double value) { start_[coordinate] = value; }

  void declare(Declaration& declaration) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  std::vector<std::pair<std::string, std::string>> attributes() const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;

 private:
  /// A displacement or angle; angles are unwrapped beside what the joint's memory and the rates let expect, so that a
  /// step may turn by more than half a turn. Memory: [value, rate of each coordinate | time], of the last accepted
  /// step.
  MeasureRate value_and_rate(std::size_t index, const LocalState& state) const;
  /// All coordinates, also rotation vectors, and their rates.
  void write_coordinates(const LocalState& state, double* values, double* rates) const;
  JointFrames frames_;
  std::vector<JointCoordinate> coordinates_;
  std::vector<double> start_;
  std::string first_name_, second_name_;
};

/// Whether a type needs an axis.
enum class AxisNeed { required, optional };

/// Reads `nodes`, `position`, `axis`, `second_axis` of a joint's entry.
JointFrames read_joint_frames(const YamlValue& entry, const Model& model, AxisNeed need);

/// The keys that `read_joint_frames` reads, with `type`.
std::vector<std::string> joint_frame_keys();

}  // namespace bielle::mechanism
