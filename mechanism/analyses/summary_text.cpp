#include "mechanism/analyses/summary_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bielle::mechanism {

std::string format_start(const StartReport& start) {
  std::string text;
  if (start.largest_displacement > 1e-9 || start.largest_rotation > 1e-9)
    text += fmt::format("  assembly moved node '{}' by {:.3g} m; largest rotation {:.3g} rad\n", start.displaced_node,
                        start.largest_displacement, start.largest_rotation);
  if (start.settled > 0)
    text += fmt::format("  static equilibrium moved node '{}' by {:.3g} m\n", start.settled_node, start.settled);
  if (start.balanced > 1e-9)
    text += fmt::format(
        "  node '{}', which has no mass, stood out of the balance of its forces: it was moved there, by {:.3g} m\n",
        start.balanced_node, start.balanced);
  if (!start.unbalanced.empty())
    text += fmt::format(
        "  {}: it has no mass, and no place near by where its forces balance: the first steps tear it somewhere, with "
        "velocities that mean nothing\n",
        start.unbalanced);
  if (start.velocity_change > 1e-9)
    text += fmt::format("  start velocities were changed by up to {:.3g} m/s to satisfy joints and drives\n",
                        start.velocity_change);
  return text;
}

std::string describe_not_unique(const std::vector<std::string>& joints) {
  if (joints.empty()) return {};
  if (joints.size() == 1)
    return fmt::format("the reaction of joint '{}' is not unique: the smallest is reported", joints.front());
  return fmt::format("the reactions of joints '{}' are not unique: the smallest are reported",
                     fmt::join(joints, "', '"));
}

std::string format_redundant(const std::vector<std::string>& redundant, const std::vector<std::string>& not_unique) {
  std::string text;
  for (const std::string& name : redundant)
    text += fmt::format("  redundant: {}; set aside\n", name);
  if (!not_unique.empty()) text += fmt::format("  {}\n", describe_not_unique(not_unique));
  return text;
}

std::string format_steps(long steps, long iterations, long records, double end_time) {
  return fmt::format("  {} steps, {:.2f} Newton iterations per step, {} rows recorded, until t = {:.6g} s\n", steps,
                     static_cast<double>(iterations) / static_cast<double>(steps), records, end_time);
}

}  // namespace bielle::mechanism
