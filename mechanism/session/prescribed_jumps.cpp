#include "mechanism/session/prescribed_jumps.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the components whose prescribed motions have a kink at a time.
std::vector<std::string> with_kink_at(const System& system, double time) {
  const double rounding = 1e-12 * std::max(std::abs(time), 1.0);
  const auto holds = [&](const std::vector<double>& times) {
    return std::any_of(times.begin(), times.end(), [&](double at) { return std::abs(at - time) <= rounding; });
  };
  std::vector<std::string> names;
  for (const Member& member : system.model().members()) {
    if (member.entry.section != Section::drives) continue;
    std::vector<double> times;
    member.component->add_break_points(times);
    if (holds(times)) names.push_back(describe(member));
  }
  for (const Node& node : system.model().nodes())
    for (const PrescribedMotion& motion : node.motion)
      if (holds(motion.break_points())) {
        names.push_back(fmt::format("node '{}'", node.name));
        break;
      }
  return names;
}

}  // namespace

void PrescribedJumps::add(const System& system, const Jump& jump) {
  if (!jump.prescribed) return;
  // The kinetic energy is compared as well, because a rate that jumps to zero does no work. Its limit is larger,
  // because the velocities of the scheme have a relative error of (omega h)^2/12, which a restart removes.
  constexpr double little = 1e-6, offset = 0.01;
  const double before = jump.before.kinetic, after = jump.after.kinetic;
  if (!(std::abs(jump.work) > little * (before + after)) && !(std::abs(after - before) > offset * (before + after)))
    return;
  const std::vector<std::string> names = with_kink_at(system, jump.time);
  if (names.empty()) return;
  jumps_.push_back({std::max(std::abs(jump.work), std::abs(after - before))});
  if (jumps_.size() > 1 && jumps_.front() > little * jumps_.back()) return;
  if (jumps_.size() > 1) jumps_.erase(jumps_.begin(), jumps_.end() - 1);  // the earlier ones were rounding
  whose_ = fmt::format("{}", fmt::join(names, ", "));
  first_ = jump.time;
  work_ = jump.work;
}

std::vector<std::string> PrescribedJumps::warnings(double largest) const {
  const long count = std::count_if(jumps_.begin(), jumps_.end(), [&](double each) { return each > 1e-6 * largest; });
  if (count == 0 || !(jumps_.front() > 1e-6 * largest)) return {};
  return {fmt::format(
      "prescribed motions jump in their rate {}, first at t = {:.6g} s ({}), by an impulse whose work is {:.3g} "
      "J and whose force no row shows: give a motion without corners (a table is a broken line, `spline` "
      "is smooth)",
      count == 1 ? "once" : fmt::format("{} times", count), first_, whose_, work_)};
}

}  // namespace bielle::mechanism
