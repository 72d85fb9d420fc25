// Measures of joints: a coordinate, its rate, a component of the reaction.
#pragma once

#include "mechanism/joints/joint.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

/// Common base of measures of joints: their only reference is the joint.
class JointMeasure : public Measure {
 public:
  JointMeasure(std::string name, const Joint& joint) : Measure(std::move(name)), joint_(joint) {}

 protected:
  const Joint& joint() const { return joint_; }
  void declare_subjects(Declaration& declaration) const final { declaration.references = {&joint_}; }

 private:
  const Joint& joint_;
};

/// The measure "main.angle", counted over turns.
class CoordinateMeasure final : public JointMeasure {
 public:
  CoordinateMeasure(std::string name, const Joint& joint, std::size_t coordinate)
      : JointMeasure(std::move(name), joint), coordinate_(coordinate) {}
  std::string units() const override { return joint().coordinates()[coordinate_].units(); }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;

 private:
  std::size_t coordinate_;
};

/// "main.angle.rate"
class CoordinateRateMeasure final : public JointMeasure {
 public:
  CoordinateRateMeasure(std::string name, const Joint& joint, std::size_t coordinate)
      : JointMeasure(std::move(name), joint), coordinate_(coordinate) {}
  std::string units() const override { return joint().coordinates()[coordinate_].rate_units(); }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;

 private:
  std::size_t coordinate_;
};

/// The measure "main.reaction.x": x y z [N], rx ry rz [N m], in the joint's frame.
class ReactionMeasure final : public JointMeasure {
 public:
  ReactionMeasure(std::string name, const Joint& joint, int direction)
      : JointMeasure(std::move(name), joint), direction_(direction) {}
  std::string units() const override { return direction_ < 3 ? "N" : "N m"; }
  bool reads_reactions() const override { return true; }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;

 private:
  int direction_;
};

}  // namespace bielle::mechanism
