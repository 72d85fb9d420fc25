// A joint between two nodes: its frames, its coordinates, and its records. What a type constrains is in its
// own file.
//
// The joint's frame J_A rides on the first node, J_B on the second (joint_frames.hpp). Coordinates are zero where they
// coincide; angles are counted over any number of turns.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/joints/joint_frames.hpp"
#include "mechanism/measures/coordinate.hpp"
#include "mechanism/measures/pair_measure.hpp"
#include "mechanism/model/model.hpp"

namespace bielle::mechanism {

/// Coordinates along which a joint's bodies slide on each other at one surface.
struct SlidingSurface {
  std::vector<std::size_t> coordinates;
  double lead = 0;  ///< of a thread, whose displacement and angle are one motion: [m] per radian; 0: none
  /// Radius of a roller [m] that turns on its pin: `coordinates` are the way of its middle along what it rolls on and
  /// the angle of what bears the pin, and the roller turns relative to its pin at way/roller - angle. 0: none
  double roller = 0;
};

class Joint : public Component {
 public:
  Joint(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
        const Model& model);

  const JointFrames& frames() const { return frames_; }
  const std::vector<JointCoordinate>& coordinates() const { return coordinates_; }
  /// @throws std::out_of_range when there is none of that name
  std::size_t coordinate_index(const std::string& name) const;
  /// The value, counted over turns, and the rate. @param state  of this joint
  CoordinateRate coordinate(std::size_t index, const LocalState& state) const;
  /// The same with all derivatives over the joint's local layout.
  virtual void calc_coordinate(std::size_t index, const LocalState& state, CoordinateDerivatives& jet) const;
  /// First and second time derivative of the coordinate. @param jet  of calc_coordinate at the state
  static std::pair<double, double> calc_coordinate_rates(const LocalState& state, CoordinateDerivatives& jet);

  /// Force and moment that the joint exerts on its second node, about the attachment point there, along the axes of its
  /// frame: those of the multipliers as reported, in whatever axes the rows are written.
  virtual Vector6 calc_reaction(const LocalState& state) const;
  /// The same with its derivatives over the joint's local layout. @param derivatives  (6, slots().size())
  virtual Vector6 calc_reaction(const LocalState& state, MatrixX& derivatives) const;
  /// Its derivatives by rates, of a joint whose reaction has any. @param derivatives  (6, slots().size())
  void calc_reaction_by_rates(const LocalState& state, MatrixX& derivatives) const;
  /// Whether the reaction depends on rates by itself: forces of dampers and friction, not of constraints.
  virtual bool reaction_has_rates() const { return false; }
  /// Contribution of each multiplier to the reaction. @returns (6, multipliers)
  MatrixX reaction_of_multipliers(const LocalState& state) const;

  /// What other entries make of a coordinate, noted while the model is read: it has one drive, and a drive by motion
  /// tolerates no lock.
  struct CoordinateUse {
    std::string driver;  ///< name of its drive; empty: there is none
    bool locked = false;
  };
  CoordinateUse& use(std::size_t coordinate) { return uses_[coordinate]; }

  /// Where friction acts. Default: at one surface along all coordinates, where these are no more than three.
  virtual std::vector<SlidingSurface> sliding_surfaces() const;
  /// What of the reaction presses surfaces that slide: all of it, unless it bears the friction as well (along a curve,
  /// path_press.hpp).
  virtual Vector6 calc_press(const LocalState& state) const { return calc_reaction(state); }
  /// The same with its derivatives over the joint's local layout. @param derivatives  (6, slots().size())
  virtual Vector6 calc_press(const LocalState& state, MatrixX& derivatives) const {
    return calc_reaction(state, derivatives);
  }
  /// A result of what acts along the coordinates: a force or torque for each, summed over all that acts so.
  OutputField force_field(const std::string& name, const std::string& description) const;

  const std::string& first_name() const { return first_name_; }
  const std::string& second_name() const { return second_name_; }

  /// The value of an angle at the start [rad], to count turns from (a drive begins some turns away). Default 0.
  /// @param by_motion  statics bring it there with the factor of motions
  virtual void start_at(std::size_t coordinate, double value, bool by_motion = true) {
    start_[coordinate] = {value, by_motion};
  }
  double starts_at(std::size_t coordinate) const { return start_[coordinate].value; }

  void declare(Declaration& declaration) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  std::vector<std::pair<std::string, std::string>> attributes() const override;
  /// Nodes, and the axes of the joint's frame.
  void describe(const LocalState& state, Description& description) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void add_reaction_norm(const LocalState& state, double arm, Eigen::Ref<MatrixX> H) const override;
  /// "<coordinate>", "<coordinate>.rate", "reaction.x" (y z rx ry rz).
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  // joint_start.cpp
  std::vector<StartCoordinate> start_coordinates() const override;
  StartCoordinateValue calc_start_coordinate(std::size_t index, const LocalState& state,
                                             MeasureGradient& gradient) const override;
  /// Of an arm that bridges its nodes, where the file does not say where it is attached.
  std::string remark() const override;

 protected:
  /// x, y or z component, in the frame J_A, of the way from the origin of J_A to that of J_B.
  PairMeasure position(int axis, const LocalState& state) const;
  /// A coordinate that the type defines (JointCoordinate::by_type): an angle in (-pi, pi].
  virtual PairMeasure calc_own_coordinate(std::size_t index, const LocalState& state) const;
  /// A coordinate's value, angles in (-pi, pi], and its rate.
  virtual CoordinateRate principal_coordinate(std::size_t index, const LocalState& state) const;

 private:
  /// An angle with the number of whole turns predicted from the joint's memory and the rates, so that a step may turn
  /// by more than half a turn. Memory: [value, rate of each coordinate | time], of the last accepted step.
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
