#include "mechanism/solvers/march.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "mechanism/solvers/error_norm.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Where steps have to end: the grid of fixed steps, kinks, and the end.
class Stops {
 public:
  Stops(double begin, double end, const StepOptions& options)
      : begin_(begin), end_(end), rounding_(1e-9 * options.size), kinks_(options.break_points) {
    std::sort(kinks_.begin(), kinks_.end());
    if (options.tolerance > 0) return;
    steps_ = std::max(1L, std::lround((end - begin) / options.size));
    size_ = (end - begin) / static_cast<double>(steps_);
  }

  /// Moves on to the first stop behind the given time.
  void advance(double time) {
    while (kink_ < kinks_.size() && kinks_[kink_] <= time + rounding_) ++kink_;
    stop_ = end_;
    if (steps_ > 0) {
      while (k_ <= steps_ && grid(k_) <= time + rounding_) ++k_;
      stop_ = grid(k_);
    }
    at_kink_ = kink_ < kinks_.size() && kinks_[kink_] <= stop_ + rounding_;
    // A kink beside a stop, but for rounding, is that stop.
    if (at_kink_ && kinks_[kink_] < stop_ - rounding_) stop_ = kinks_[kink_];
  }
  double time() const { return stop_; }
  bool at_kink() const { return at_kink_; }
  bool on_grid() const { return steps_ == 0 || stop_ == grid(k_); }
  double step_size() const { return size_; }  ///< of the grid

 private:
  /// Counted, not summed: the last step ends on the end.
  double grid(long k) const { return k >= steps_ ? end_ : begin_ + static_cast<double>(k) * size_; }
  double begin_, end_, rounding_, size_ = 0, stop_ = 0;
  long steps_ = 0, k_ = 1;  ///< of the grid; 0: there is none
  std::vector<double> kinks_;
  std::size_t kink_ = 0;
  bool at_kink_ = false;
};

/// The size for the next step after one of size h with this error over tolerance.
double proposed_size(double h, double error, double largest) {
  const double factor = 0.9 * std::cbrt(1 / std::max(error, 1e-6));
  if (error > 1) return h * std::clamp(factor, 0.1, 0.9);
  if (factor > 0.9 && factor < 1.25) return h;
  return std::min(h * std::clamp(factor, 0.5, 2.0), largest);
}

}  // namespace

MarchLog march(TimeIntegration& integration, double end, const StepOptions& options,
               const std::function<void(const MarchStep&)>& after_step) {
  const double begin = integration.state().time;
  const bool adaptive = options.tolerance > 0;
  Stops stops(begin, end, options);
  std::optional<ErrorNorm> norm;
  if (adaptive) norm.emplace(integration.system(), integration.environment(), integration.state());
  double size = adaptive ? std::min(options.size, options.largest) : stops.step_size();
  const double smallest = adaptive ? 1e-10 * (end - begin) : size / 1024;

  MarchLog log;
  stops.advance(begin);
  const double first = std::min(size, stops.time() - begin);
  if (std::find(options.break_points.begin(), options.break_points.end(), begin) != options.break_points.end())
    integration.restart(first);
  else
    integration.start(first);
  while (integration.state().time < end) {
    const double time = integration.state().time, left = stops.time() - time;
    // The last two steps before a stop are of one size: no sliver remains.
    const bool last = left <= size * (1 + 1e-9);
    const double h = last ? left : left < 2 * size ? left / 2 : size;
    integration.change_step(h);
    const StepReport report = integration.attempt(h, last ? stops.time() : time + h, last && stops.at_kink());
    log.iterations += report.iterations;
    double error = 0;
    if (!report.converged()) {
      ++log.refused_by_newton;
      log.hardest = report.refusal;
      size = h / 2;
      if (size < smallest)
        throw ComputationError(fmt::format("{}; steps down to {:.3g} s have been tried", report.refusal, h));
      continue;
    }
    if (adaptive) {
      error = (*norm)(integration) / options.tolerance;
      if (error > 1) {
        ++log.refused_by_error;
        size = proposed_size(h, error, options.largest);
        if (size < smallest)
          throw ComputationError(
              fmt::format("t = {:.6g} s: the local error stays {:.3g} times the tolerance with a step of {:.3g} s",
                          time, error, h));
        continue;
      }
    }
    integration.accept();
    ++log.steps;
    if (report.iterations > log.most_iterations) {
      log.most_iterations = report.iterations;
      log.most_iterations_at = integration.state().time;
    }
    if (!last || !stops.at_kink()) {
      log.smallest = log.smallest > 0 ? std::min(log.smallest, h) : h;
      log.largest = std::max(log.largest, h);
    }
    after_step({report, error, last && stops.on_grid()});
    if (adaptive)
      size = std::max(proposed_size(h, error, options.largest), last ? size : 0);
    else if (size < stops.step_size())
      size = std::min(2 * size, stops.step_size());
    if (!last) continue;
    const bool kink = stops.at_kink();
    if (stops.time() >= end) break;
    stops.advance(stops.time());
    if (kink) integration.restart(std::min(size, stops.time() - integration.state().time));
  }
  return log;
}

}  // namespace bielle::mechanism
