// The step recorders of a superelement use its deformation, which is computed once in each step for all of them.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "mechanism/math/types.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

/// Deformation and acceleration of a superelement at one state.
struct BodyDeformation {
  VectorX eps;         ///< linear coordinates, in the layout of corotated_frame.hpp
  double elastic = 0;  ///< energy [J]
  /// Acceleration minus gravity as a linear field in space: (4 i + j), direction i in body axes times 1 [m/s^2], x, y,
  /// z [1/s^2] from the centre of mass. It is the acceleration of the body's frame and of points that move rigidly with
  /// this frame.
  Eigen::Matrix<double, 12, 1> acceleration = Eigen::Matrix<double, 12, 1>::Zero();
};

/// The first of the step recorders of a body: it computes the deformation for the others.
class DeformationReader final : public StepRecorder {
 public:
  using Read = std::function<void(const LocalState& state, BodyDeformation& deformation)>;
  explicit DeformationReader(Read read) : read_(std::move(read)), now_(std::make_shared<BodyDeformation>()) {}
  std::shared_ptr<const BodyDeformation> now() const { return now_; }

  void begin() override {}
  void add(const LocalState& state) override { read_(state, *now_); }
  void exchange(Archive&) override {}
  std::vector<ResultArray> results() override { return {}; }
  std::string summary() override { return {}; }
  std::string what() const override { return "deformation"; }

 private:
  Read read_;
  std::shared_ptr<BodyDeformation> now_;
};

}  // namespace bielle::mechanism
