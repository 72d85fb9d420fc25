// Whether the stress of a superelement is complete: what its modes lack of the answer to its own inertia.
//
// With its interfaces held, the body gives way under the accelerations c of its motion (gravity is one) by a static
// answer of the energy c^T W c / 2, of which modes and residual vectors lack c^T D c / 2 (`/reduced/inertia_answer` of
// the file). The lacking part is orthogonal in stiffness to all that the body has, of the energy V: the body lacks the
// share sqrt(D / (V + D)) of its stress, in the energy norm (the root of the mean square). Both energies are the
// largest of the motion, since stress is looked at where it is large, and accelerations are ahead of the stress that
// they cause.
//
// Accelerations are means of two steps: those that alternate from step to step are the scheme's ringing.
// The estimate contains neither vibrations of the modes left out nor the stress that loads inside the body cause next
// to their points.
#pragma once

#include <memory>
#include <string>

#include "mechanism/elements/superelement/body_deformation.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

class StressCompleteness final : public StepRecorder {
 public:
  /// @param answer  not empty @param deformation  renewed before each `add`
  StressCompleteness(std::string body, const InertiaAnswer& answer, std::shared_ptr<const BodyDeformation> deformation);

  void begin() override;
  void add(const LocalState& state) override;
  void exchange(Archive& archive) override;
  std::vector<ResultArray> results() override;
  std::string summary() override;
  std::string what() const override { return "completeness of the stress of '" + body_ + "'"; }

 private:
  double missing_share() const;  ///< of the stress, 0..1

  std::string body_;
  Eigen::Matrix<double, 12, 12> whole_, missing_;
  std::shared_ptr<const BodyDeformation> deformation_;
  Eigen::Matrix<double, 12, 1> before_ = Eigen::Matrix<double, 12, 1>::Zero();  ///< accelerations at the last state
  bool began_ = false;                                                          ///< there was a state before
  double largest_missing_ = 0, elastic_ = 0;                                    ///< energies [J]
  double modes_share_ = 1;  ///< of the held body's answer, where most is missing
  double time_ = 0;
  bool statics_ = false;  ///< the time is a load factor
};

}  // namespace bielle::mechanism
