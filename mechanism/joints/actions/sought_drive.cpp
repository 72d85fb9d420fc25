#include "mechanism/joints/actions/sought_drive.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Records the largest effort of an analysis, for its summary.
class LargestEffort final : public StepRecorder {
 public:
  explicit LargestEffort(const SoughtDrive& drive) : drive_(drive) {}
  void begin() override {
    largest_ = time_ = 0;
    states_ = 0;
  }
  void add(const LocalState& state) override {
    ++states_;
    const double force = drive_.force(state);
    if (std::abs(force) <= std::abs(largest_)) return;
    largest_ = force;
    time_ = state.time();
  }
  void exchange(Archive& archive) override {
    archive(largest_);
    archive(time_);
    archive.within(states_, 0, 1e15);
  }
  std::vector<ResultArray> results() override { return {}; }
  std::string summary() override {
    if (states_ < 2) return {};  // no effort was sought, for example in modes about a state
    return fmt::format("  drive '{}' takes up to {:.6g} {} (at t = {:.6g} s)\n", drive_.name(), largest_,
                       drive_.coordinate().force_units(), time_);
  }
  std::string what() const override { return "largest effort of '" + drive_.name() + "'"; }

 private:
  const SoughtDrive& drive_;
  double largest_ = 0, time_ = 0;
  long states_ = 0;
};

}  // namespace

void SoughtDrive::declare(Declaration& declaration) const {
  declare_drive(declaration);
  declaration.memory.push_back(0);
}

void SoughtDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const double u = force(state);
  if (!tangent.wants_K || u == 0) return;
  CoordinateDerivatives& jet = calc(state);
  const int at = row(state);
  const auto n = jet.w().size();
  tangent.K.dense().block(at, at, n, n) -= u * jet.W();
}

std::unique_ptr<StepRecorder> SoughtDrive::make_step_recorder() const { return std::make_unique<LargestEffort>(*this); }

SoughtEffort::Sought SoughtDrive::sought() const {
  const bool turns = coordinate().kind != JointCoordinate::Kind::displacement;
  return {static_cast<int>(own_memory()), turns, moves_,
          fmt::format("the {} on {} of joint '{}'", turns ? "torque" : "force", coordinate().name, joint().name())};
}

Drive::LawText SoughtDrive::law_text() const {
  return {fmt::format("{} on {}", sought().turns ? "torque" : "force", coordinate().name), "sought by inverse dynamics",
          coordinate().force_units()};
}

}  // namespace bielle::mechanism
