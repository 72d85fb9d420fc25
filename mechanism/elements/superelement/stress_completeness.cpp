#include "mechanism/elements/superelement/stress_completeness.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

constexpr double worth_a_word = 0.05;  // missing fraction of the stress above which the summary reports it
// Below this share of the modes in the held body's response the report is a warning.
constexpr double enough_of_answer = 0.95;

}  // namespace

StressCompleteness::StressCompleteness(std::string body, const InertiaAnswer& answer,
                                       std::shared_ptr<const BodyDeformation> deformation)
    : body_(std::move(body)), whole_(answer.whole), missing_(answer.missing), deformation_(std::move(deformation)) {}

void StressCompleteness::begin() {
  largest_missing_ = elastic_ = time_ = 0;
  modes_share_ = 1;
  before_.setZero();
  statics_ = began_ = false;
}

void StressCompleteness::add(const LocalState& state) {
  statics_ = state.environment().statics;
  const Eigen::Matrix<double, 12, 1> c =
      began_ && !statics_ ? 0.5 * (before_ + deformation_->acceleration) : deformation_->acceleration;
  before_ = deformation_->acceleration;
  began_ = true;
  elastic_ = std::max(elastic_, deformation_->elastic);
  const double missing = 0.5 * c.dot(missing_ * c);
  if (!(missing > largest_missing_)) return;
  largest_missing_ = missing;
  modes_share_ = std::clamp(1 - missing / (0.5 * c.dot(whole_ * c)), 0.0, 1.0);
  time_ = statics_ ? state.environment().load_factor : state.time();
}

void StressCompleteness::exchange(Archive& archive) {
  for (double* value : {&largest_missing_, &elastic_, &modes_share_, &time_}) archive(*value);
  for (double& value : before_) archive(value);
  archive(statics_);
  archive(began_);
}

double StressCompleteness::missing_share() const {
  return largest_missing_ > 0 ? std::sqrt(largest_missing_ / (largest_missing_ + elastic_)) : 0;
}

std::vector<ResultArray> StressCompleteness::results() {
  const std::string group = fmt::format("validity/{}/", body_);
  return {{group + "missing_stress",
           {},
           {missing_share()},
           "-",
           "share of the stress (energy norm) that modes lack under the body's own inertia"},
          {group + "modes_share",
           {},
           {modes_share_},
           "-",
           "fraction of the held body's static response to the accelerations that the modes represent, at the time at "
           "which most is missing"}};
}

std::string StressCompleteness::summary() {
  const double missing = missing_share();
  if (missing < worth_a_word) return {};
  return fmt::format(
      "  {}superelement '{}' lacks about {:.0f} % of its stress (energy norm): under the accelerations at {} its "
      "modes, with the interfaces held, deflect by {:.1f} % of the deflection of the mesh; reduce it with "
      "`inertia_relief: true`\n",
      modes_share_ < enough_of_answer ? "warning: " : "", body_, 100 * missing,
      statics_ ? fmt::format("load factor {:.6g}", time_) : fmt::format("t = {:.6g} s", time_), 100 * modes_share_);
}

}  // namespace bielle::mechanism
