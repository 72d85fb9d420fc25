// Completeness of the stress of a superelement: the part of its response to its own inertia that its modes do not
// contain.
//
// With fixed interfaces, the body responds to the accelerations c of its motion (including gravity) by a static
// deformation of the energy c^T W c / 2, of which modes and residual vectors do not contain c^T D c / 2
// (`/reduced/inertia_answer` of the file). The missing part is orthogonal in stiffness to the space of the basis, with
// the energy V: the fraction sqrt(D / (V + D)) of the stress of the body is missing, in the energy norm (the root of
// the mean square). Both energies are the largest of the motion, since stress is used where it is large, and
// accelerations precede the stress that they cause.
//
// Accelerations are means of two steps: accelerations that alternate from step to step are oscillations of the scheme.
// The estimate contains neither vibrations of omitted modes nor the local stress due to loads inside the body.
#pragma once

#include <memory>
#include <string>

#include "mechanism/elements/superelement/body_deformation.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

class StressCompleteness final : public StepRecorder {
 public:
  /// @param answer  inertia answer of the file, not empty @param deformation  updated before each `add`
  StressCompleteness(std::string body, const InertiaAnswer& answer, std::shared_ptr<const BodyDeformation> deformation);

  void begin() override;
  void add(const LocalState& state) override;
  void exchange(Archive& archive) override;
  std::vector<ResultArray> results() override;
  std::string summary() override;
  std::string what() const override { return "completeness of the stress of '" + body_ + "'"; }

 private:
  double missing_share() const;  ///< fraction of the stress, 0..1

  std::string body_;
  Eigen::Matrix<double, 12, 12> whole_, missing_;
  std::shared_ptr<const BodyDeformation> deformation_;
  Eigen::Matrix<double, 12, 1> before_ = Eigen::Matrix<double, 12, 1>::Zero();  ///< accelerations at the last state
  bool began_ = false;                                                          ///< there was an earlier state
  double largest_missing_ = 0, elastic_ = 0;                                    ///< energies [J]
  double modes_share_ = 1;  ///< fraction of the modes in the held body's response, at the largest missing energy
  double time_ = 0;
  bool statics_ = false;  ///< the time is a load factor
};

}  // namespace bielle::mechanism
