#include "mechanism/solvers/dynamics/event_locator.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {
namespace {

double side_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

}  // namespace

EventLocator::EventLocator(const System& system) : system_(system), values_(system) {
  const auto count = static_cast<Eigen::Index>(system.event_functions().size());
  for (VectorX* vector : {&sides_, &at_start_, &at_low_, &at_high_, &weight_}) vector->setZero(count);
  last_end_.assign(system.event_functions().size(), 0);
  for (Eigen::Index k = 0; k < sides_.size(); ++k)
    sides_[k] = system.event_functions()[static_cast<std::size_t>(k)].function.begins_on;
  std::size_t declared = system.model().members().size();  // member whose declaration is cached; initially none
  bool kinks = false;
  for (const MemberEventFunction& each : system.event_functions()) {
    if (each.member != declared) {
      Declaration declaration;
      system.model().members()[each.member].component->declare(declaration);
      kinks = declaration.kinks;
      declared = each.member;
    }
    // A force that begins continuously (contact of surfaces) ends a step as well, without a restart.
    ends_step_.push_back(each.function.restarts || each.function.stops || kinks);
  }
}

std::vector<int> EventLocator::begin(const State& state, const Environment& environment, const std::vector<int>& passed,
                                     bool one_alone) {
  values_.calc(state, environment, at_start_);
  const auto met = [&](int k) { return std::find(passed.begin(), passed.end(), k) != passed.end(); };
  std::vector<int> jumped;
  for (int k = 0; k < static_cast<int>(sides_.size()); ++k) {
    const double side = side_of(at_start_[k]);
    // An event that does not end steps may have occurred exactly at the end of the last step.
    if (side == 0 || (side == -sides_[k] && !ends_step_[static_cast<std::size_t>(k)] && met(k))) continue;
    if (side == -sides_[k] && counts(k))
      jumped.push_back(k);
    else
      sides_[k] = side;
  }
  let_one_go(jumped, at_start_);
  if (one_alone && jumped.size() > 1)
    jumped = {*std::min_element(jumped.begin(), jumped.end(),
                                [&](int a, int b) { return sides_[a] * at_start_[a] < sides_[b] * at_start_[b]; })};
  for (const int k : jumped) sides_[k] = -sides_[k];
  std::erase_if(jumped, met);
  return jumped;
}

void EventLocator::let_one_go(std::vector<int>& crossed, const VectorX& values) const {
  const auto one_by_one = [&](int k) {
    return system_.event_functions()[static_cast<std::size_t>(k)].function.one_by_one;
  };
  int first = -1;
  for (const int k : crossed)
    if (one_by_one(k) && (first < 0 || values[k] < values[first])) first = k;
  std::erase_if(crossed, [&](int k) { return one_by_one(k) && k != first; });
}

bool EventLocator::counts(int k) const {
  using Direction = EventFunction::Direction;
  const Direction direction = system_.event_functions()[static_cast<std::size_t>(k)].function.direction;
  return direction == Direction::both || (direction == Direction::rising) == (sides_[k] < 0);
}

bool EventLocator::has_crossed(int k, double value) const {
  const double side = sides_[k];
  if (side == 0 || side * value > 0) return false;
  // If the value is zero at the start and at the end, no event has occurred. Its later sign defines the side.
  if (value == 0 && at_start_[k] == 0) return false;
  return counts(k);
}

void EventLocator::collect(const VectorX& values, std::vector<int>& crossed) const {
  crossed.clear();
  for (int k = 0; k < static_cast<int>(values.size()); ++k)
    if (ends_step_[static_cast<std::size_t>(k)] && has_crossed(k, values[k])) crossed.push_back(k);
}

bool EventLocator::found(const State& end, const Environment& environment, double h, double tolerance) {
  values_.calc(end, environment, at_high_);
  collect(at_high_, crossed_);
  low_ = 0;
  high_ = h;
  at_low_ = at_start_;
  weight_.setOnes();
  std::fill(last_end_.begin(), last_end_.end(), 0);
  tolerance_ = tolerance;
  step_ = h;
  return !crossed_.empty();
}

double EventLocator::shortest() const {
  double share = 0;
  for (const int k : crossed_)
    share = std::max(share, system_.event_functions()[static_cast<std::size_t>(k)].function.nearest);
  return share * step_;
}

bool EventLocator::located() const {
  const double width = high_ - low_;
  if (width <= tolerance_ || high_ <= shortest()) return true;
  double farthest = 0;  // error estimate of the secant
  for (const int k : crossed_)
    farthest = std::max(farthest, width * std::abs(at_high_[k]) / (std::abs(at_high_[k]) + std::abs(at_low_[k])));
  // If a value is zero at both ends, the secant gives no information.
  return farthest <= tolerance_;
}

double EventLocator::proposal() const {
  const double width = high_ - low_;
  double earliest = high_;
  for (const int k : crossed_) {
    const double low = std::abs(weight_[k] * at_low_[k]), high = std::abs(at_high_[k]);
    const bool secant = low > 0 && side_of(at_low_[k]) != side_of(at_high_[k]);
    earliest = std::min(earliest, low_ + (secant ? low / (low + high) : 0.5) * width);
  }
  // The step ends slightly past the zero, and away from the ends of the bracket, so that both ends move.
  const double least = std::min(1e-3 * width, 0.5 * tolerance_);
  return std::max(shortest(), std::clamp(earliest + 0.5 * tolerance_, low_ + least, high_ - least));
}

void EventLocator::narrow(const State& end, const Environment& environment, double h) {
  VectorX values(at_high_.size());
  values_.calc(end, environment, values);
  std::vector<int> crossed;
  collect(values, crossed);
  const bool behind = !crossed.empty();
  // The weight of an end that is retained twice is halved.
  for (const int k : behind ? crossed : crossed_) {
    int& last = last_end_[static_cast<std::size_t>(k)];
    const int moved = behind ? 1 : -1;
    if (last == moved) weight_[k] *= behind ? 0.5 : 2;
    if (last != moved) weight_[k] = 1;
    last = moved;
  }
  (behind ? high_ : low_) = h;
  (behind ? at_high_ : at_low_) = values;
  if (behind) crossed_ = crossed;
}

std::vector<int> EventLocator::pass() {
  let_one_go(crossed_, at_high_);
  for (const int k : crossed_) sides_[k] = -sides_[k];
  return crossed_;
}

double EventLocator::locate_noted(int k, double begin, double end, const std::function<State(double)>& between,
                                  const Environment& environment, double tolerance) {
  constexpr int most = 100;
  double low = begin, high = end, at_low = at_start_[k], at_high = at_high_[k];
  int moved = 0;  // the end that moved last
  for (int i = 0; i < most && high - low > tolerance; ++i) {
    const bool secant = side_of(at_low) * side_of(at_high) < 0;
    const double share = secant ? std::abs(at_low) / (std::abs(at_low) + std::abs(at_high)) : 0.5;
    // The time is past the zero by less than the tolerance, so that the upper end converges to it.
    const double width = high - low, least = std::min(1e-3 * width, 0.5 * tolerance);
    const double time = std::clamp(low + share * width + 0.5 * tolerance, low + least, high - least);
    if (!(time > low && time < high)) break;
    const double value = values_.calc(between(time), environment, k);
    const bool behind = sides_[k] * value <= 0;
    (behind ? high : low) = time;
    (behind ? at_high : at_low) = value;
    // The weight of an end that is retained twice is halved.
    if (moved == (behind ? 1 : -1)) (behind ? at_low : at_high) *= 0.5;
    moved = behind ? 1 : -1;
  }
  return high;
}

std::vector<EventLocator::Noted> EventLocator::pass_noted(double begin, double end,
                                                          const std::function<State(double)>& between,
                                                          const Environment& environment, double tolerance) {
  std::vector<Noted> noted;
  for (int k = 0; k < static_cast<int>(sides_.size()); ++k) {
    if (ends_step_[static_cast<std::size_t>(k)] || !has_crossed(k, at_high_[k])) continue;
    noted.push_back({locate_noted(k, begin, end, between, environment, tolerance), k});
  }
  for (const Noted& each : noted) sides_[each.event_function] = -sides_[each.event_function];
  return noted;
}

void EventLocator::exchange(Archive& archive) {
  for (double& side : sides_) archive.within(side, -1, 1);
}

}  // namespace bielle::mechanism
