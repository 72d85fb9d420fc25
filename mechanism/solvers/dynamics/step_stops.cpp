#include "mechanism/solvers/dynamics/step_stops.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanism/system/sampling.hpp"

namespace bielle::mechanism {

StepStops::StepStops(double begin, double end, const StepOptions& options, std::vector<Sampler::Instants> instants)
    : begin_(begin),
      end_(end),
      rounding_(0.5e-12 * options.size),
      kinks_(options.break_points),
      instants_(std::move(instants)) {
  std::sort(kinks_.begin(), kinks_.end());
  if (options.tolerance > 0) return;
  steps_ = std::max(1L, std::lround((end - begin) / options.size));
  size_ = (end - begin) / static_cast<double>(steps_);
}

void StepStops::advance(double time) {
  while (kink_ < kinks_.size() && kinks_[kink_] <= time + rounding(time)) ++kink_;
  stop_ = end_;
  if (steps_ > 0) {
    while (k_ <= steps_ && grid(k_) <= time + rounding(time)) ++k_;
    stop_ = grid(k_);
  }
  at_kink_ = kink_ < kinks_.size() && kinks_[kink_] <= stop_ + rounding(stop_);
  // A kink at a stop, up to rounding, is identified with that stop.
  if (at_kink_ && kinks_[kink_] < stop_ - rounding(stop_)) stop_ = kinks_[kink_];
  // An instant close to a stop is identified with it too, so that equal steps that divide a period are not changed.
  for (const Sampler::Instants& each : instants_)
    if (const double at = next_instant(each, time, rounding(time)); at < stop_ - rounding(stop_)) {
      stop_ = at;
      at_kink_ = false;
    }
}

void StepStops::heed(double kink) {
  if (kink > stop_ + rounding(stop_)) return;
  at_kink_ = true;
  if (kink < stop_ - rounding(stop_)) stop_ = kink;
}

double StepStops::rounding(double time) const {
  return rounding_ + 4 * std::numeric_limits<double>::epsilon() * std::abs(time);
}

}  // namespace bielle::mechanism
