// A joint between two nodes: its frames, its coordinates, and its records. The constraints of each type are in its own
// file.
//
// The joint's frame J_A is fixed on the first node, J_B on the second (joint_frames.hpp). Coordinates are zero if the
// frames coincide; angles are counted over any number of turns.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/joints/joint_frames.hpp"
#include "mechanism/measures/coordinate.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/start_coordinates.hpp"

namespace bielle::mechanism {

/// A sliding surface of a joint: the coordinates along which its bodies slide on each other.
struct SlidingSurface {
  std::vector<std::size_t> coordinates;
  double lead = 0;  ///< lead of a thread, whose displacement and angle are one motion: [m] per radian; 0: none
  /// Radius of a roller [m] that rotates on its pin; 0: there is no roller. The `coordinates` are the displacement of
  /// its middle along the path and the angle of the part that carries the pin. The roller rotates relative to its pin
  /// by displacement/roller - angle.
  double roller = 0;
};

class Joint : public Component, public StartCoordinates {
 public:
  Joint(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
        const Model& model);

  const JointFrames& frames() const { return frames_; }
  const std::vector<JointCoordinate>& coordinates() const { return coordinates_; }
  /// @throws std::out_of_range if there is no coordinate with this name
  std::size_t coordinate_index(const std::string& name) const;
  /// Returns the value, counted over turns, and the rate of a coordinate. @param state  state of this joint
  CoordinateRate coordinate(std::size_t index, const LocalState& state) const;
  /// Computes the coordinate with all derivatives over the joint's local layout.
  virtual void calc_coordinate(std::size_t index, const LocalState& state, CoordinateDerivatives& jet) const;
  /// Computes the coordinate with its gradients only, which residuals need.
  virtual void calc_slopes(std::size_t index, const LocalState& state, CoordinateSlopes& slopes) const;
  /// Computes first and second time derivative of the coordinate. @param jet  result of calc_coordinate at the state
  static std::pair<double, double> calc_coordinate_rates(const LocalState& state, CoordinateDerivatives& jet);

  /// Computes force and moment that the joint exerts on its second node, about the attachment point there, along the
  /// axes of its frame: from the reported multipliers, for any axes of the constraint rows.
  virtual Vector6 calc_reaction(const LocalState& state) const;
  /// Computes the reaction with its derivatives over the joint's local layout. @param derivatives  (6, slots().size())
  virtual Vector6 calc_reaction(const LocalState& state, MatrixX& derivatives) const;
  /// Computes the derivatives by rates, for a joint whose reaction has any. @param derivatives  (6, slots().size())
  void calc_reaction_by_rates(const LocalState& state, MatrixX& derivatives) const;
  /// Tells whether the reaction depends directly on rates: forces of dampers and friction do, forces of constraints do
  /// not.
  virtual bool reaction_has_rates() const { return false; }
  /// Computes the contribution of each multiplier to the reaction. @returns (6, multipliers)
  MatrixX reaction_of_multipliers(const LocalState& state) const;

  /// Use of a coordinate by other entries, recorded while the model is read. The forces of several drives add up. A
  /// drive by motion or with a sought effort permits neither another drive nor a lock.
  struct CoordinateUse {
    std::string driver;  ///< name of its first drive; empty: there is none
    bool locked = false;
  };
  CoordinateUse& use(std::size_t coordinate) { return uses_[coordinate]; }

  /// Returns the sliding surfaces of the joint. By default there is one surface along all coordinates, if these are no
  /// more than three.
  virtual std::vector<SlidingSurface> sliding_surfaces() const;
  /// Computes the part of the reaction that presses sliding surfaces together. This is all of it, except for joints
  /// whose reaction includes friction (along a curve, path_press.hpp).
  virtual Vector6 calc_press(const LocalState& state) const { return calc_reaction(state); }
  /// Computes this part with its derivatives over the joint's local layout. @param derivatives  (6, slots().size())
  virtual Vector6 calc_press(const LocalState& state, MatrixX& derivatives) const {
    return calc_reaction(state, derivatives);
  }
  /// Returns the output field of an action along the coordinates: a force or torque for each, summed over all actions
  /// of this kind.
  OutputField force_field(const std::string& name, const std::string& description) const;

  const std::string& first_name() const { return first_name_; }
  const std::string& second_name() const { return second_name_; }

  /// Sets the start value of an angle [rad], from which turns are counted (a drive may begin some turns away). The
  /// default is 0.
  /// @param by_motion  whether a static analysis applies the value with the factor of motions
  virtual void start_at(std::size_t coordinate, double value, bool by_motion = true) {
    start_[coordinate] = {value, by_motion};
  }
  double starts_at(std::size_t coordinate) const { return start_[coordinate].value; }

  void declare(Declaration& declaration) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  std::vector<std::pair<std::string, std::string>> attributes() const override;
  /// Describes the nodes, and the axes of the joint's frame.
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void add_reaction_norm(const LocalState& state, double arm, Eigen::Ref<MatrixX> H) const override;
  /// The names are "<coordinate>", "<coordinate>.rate", "reaction.x" (y z rx ry rz).
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  // The following functions are in joint_start.cpp.
  std::vector<StartCoordinate> start_coordinates() const override;
  StartCoordinateValue calc_start_coordinate(std::size_t index, const LocalState& state,
                                             MeasureGradient& gradient) const override;
  /// Returns a warning if the file does not give the position of the joint, and a lever arm therefore bridges the
  /// distance between its nodes.
  std::string remark() const override;

 protected:
  /// Computes a component x, y or z, in the frame J_A, of the vector from the origin of J_A to that of J_B.
  template <int order = 2>
  PairMeasureOf<order> position(int axis, const LocalState& state) const {
    const Frame &A = frames_.on_first, &B = frames_.on_second;
    return measure_position<order>(state.node(0), state.node(1), A.R.col(axis), A.x, B.x);
  }
  /// Computes a coordinate that the type defines (JointCoordinate::by_type). An angle is in (-pi, pi].
  virtual PairMeasure calc_own_coordinate(std::size_t index, const LocalState& state) const;
  /// Computes this coordinate with its gradient only. By default the second derivatives are dropped.
  virtual PairSlope calc_own_slope(std::size_t index, const LocalState& state) const;
  /// Returns a coordinate's value, angles in (-pi, pi], and its rate.
  virtual CoordinateRate principal_coordinate(std::size_t index, const LocalState& state) const;

 private:
  bool is_rotation(std::size_t index) const;  ///< whether it is a component of the rotation vector
  template <int order>
  PairMeasureOf<order> measure(std::size_t index, const LocalState& state) const;
  /// Sets value, rate and gradients. The type is that of a measure of either order.
  template <class Measure>
  void set_slopes(std::size_t index, const LocalState& state, const Measure& m, CoordinateSlopes& slopes) const;
  /// Returns an angle with the number of whole turns predicted from the joint's memory and the rates, so that a step
  /// may rotate by more than half a turn. The memory is [value, rate of each coordinate | time], of the last accepted
  /// step.
  double counted(std::size_t index, const LocalState& state, const CoordinateRate& principal) const;
  JointFrames frames_;
  std::vector<JointCoordinate> coordinates_;
  struct Start {
    double value = 0;
    bool by_motion = true;
  };
  std::vector<Start> start_;
  std::vector<CoordinateUse> uses_;
  std::string first_name_, second_name_;
};

}  // namespace bielle::mechanism
