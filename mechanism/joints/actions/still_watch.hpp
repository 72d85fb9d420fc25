// Detects a force or torque without effect, whose coordinate does not move during a motion.
#pragma once

#include "mechanism/joints/actions/actuator_drive.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

class StillWatch final : public StepRecorder {
 public:
  /// The object keeps a reference to the drive, which must outlive it.
  explicit StillWatch(const ActuatorDrive& drive) : drive_(drive) {}
  void begin() override;
  void add(const LocalState& state) override;
  void exchange(Archive& archive) override;
  std::vector<ResultArray> results() override { return {}; }
  std::string summary() override;
  std::string what() const override { return "motion of '" + drive_.name() + "'"; }

 private:
  const ActuatorDrive& drive_;
  double most_force_ = 0;  ///< largest force [N] or [N m]
  double first_ = 0;       ///< first value of the coordinate
  double farthest_ = 0;    ///< largest distance from it
  long states_ = 0;
};

}  // namespace bielle::mechanism
