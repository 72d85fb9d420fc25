// Step recorder that reports a cylinder without stops that has left its stroke.
#pragma once

#include "mechanism/hydraulics/actuators/cylinder.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

class StrokeWatch final : public StepRecorder {
 public:
  explicit StrokeWatch(const Cylinder& cylinder) : cylinder_(cylinder) {}
  void begin() override { most_ = {}; }
  void add(const LocalState& state) override;
  void exchange(Archive& archive) override;
  std::vector<ResultArray> results() override { return {}; }
  std::string summary() override;
  std::string what() const override;

 private:
  /// The state with the largest distance beyond an end.
  struct Beyond {
    double way = 0, length = 0, time = 0;  ///< distance beyond the end [m], length [m], time [s]
  };
  const Cylinder& cylinder_;
  Beyond most_;
};

}  // namespace bielle::mechanism
