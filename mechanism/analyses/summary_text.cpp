#include "mechanism/analyses/summary_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/solvers/statics/held_states.hpp"
#include "mechanism/system/loose_parts.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {

namespace {

constexpr std::size_t most_moved = 10;  // rows of a list

std::string with_degrees(double angle) { return fmt::format("{:.3g} rad ({:.3g} degrees)", angle, angle * 180 / M_PI); }

/// Describes the movements made by the assembly, the largest first. A list with a single node would add no information.
std::string format_moved(const StartReport& start) {
  std::string text;
  const auto rest = [](std::size_t count, const char* of) {
    return count > most_moved ? fmt::format("    and {} more {} by less\n", count - most_moved, of) : "";
  };
  if (start.moved_nodes.size() > 1) {
    for (std::size_t k = 0; k < std::min(most_moved, start.moved_nodes.size()); ++k) {
      const MovedNode& node = start.moved_nodes[k];
      text += fmt::format("    node '{}': {:.3g} m, {:.3g} degrees\n", node.name, node.displacement,
                          node.rotation * 180 / M_PI);
    }
    text += rest(start.moved_nodes.size(), "nodes");
  }
  for (std::size_t k = 0; k < std::min(most_moved, start.moved_coordinates.size()); ++k) {
    const MovedCoordinate& coordinate = start.moved_coordinates[k];
    const double change = coordinate.to - coordinate.from;
    text += fmt::format(
        "    {}: {}, to {:.6g} {}\n", coordinate.name,
        coordinate.units == "rad" ? with_degrees(change) : fmt::format("{:.3g} {}", change, coordinate.units),
        coordinate.to, coordinate.units);
  }
  return text + rest(start.moved_coordinates.size(), "coordinates");
}

std::string format_carried(const CarriedPart& part) {
  constexpr std::size_t most = 20;
  const std::size_t shown = std::min(most, part.nodes.size());
  std::string text = fmt::format("  {} carries as one rigid body: ", part.joint);
  if (shown > 0)
    text += fmt::format("{} '{}'", part.nodes.size() == 1 ? "node" : "nodes",
                        fmt::join(part.nodes.begin(), part.nodes.begin() + static_cast<std::ptrdiff_t>(shown), "', '"));
  if (part.nodes.size() > shown) text += fmt::format(" and {} more", part.nodes.size() - shown);
  if (part.inner > 0)
    text += fmt::format("{}{}", shown > 0 ? ", " : "",
                        counted(part.inner, "node within elements", "nodes within elements"));
  return text + "\n";
}

/// Describes the axes of small motions about a state, and the unbalance of this state.
std::string format_axes(const LinearisedSetting& setting, const char* what) {
  constexpr double balanced = 1e-6;  // fraction of the largest force: equilibria are found to 1e-9
  if (!setting.steadiness)
    return setting.unbalance <= balanced ? ""
                                         : fmt::format(
                                               "  the state is at rest but not in equilibrium: the residual of {} is "
                                               "{:.2g} of the largest force; {} are those of the equations as they are "
                                               "there (a static analysis before this one finds the equilibrium)\n",
                                               setting.unbalanced, setting.unbalance, what);
  std::string text = fmt::format("  in motion, seen in axes that {}\n",
                                 setting.axes == ModeAxes::turning ? "turn with each node" : "do not turn");
  if (!setting.standing.empty())
    text += fmt::format(
        "  warning: forces keep their direction while the mechanism turns, as gravity across the axis does ({}): {} "
        "are "
        "those about a deflection by them that turns as well; leave these forces out, or let `rotation` name the "
        "joint behind which the rotor turns\n",
        setting.standing, what);
  if (!setting.steadiness->steady())
    text += fmt::format(
        "  the motion is not steady, or not in axes of these kinds: the equations change while it goes on, and {} are "
        "those of the equations as they are at this moment\n",
        what);
  return text;
}

}  // namespace

std::string format_energies(const Energy& energy) {
  return fmt::format(
      "  energy at the end [J]: kinetic {:.6g}, elastic {:.6g}, gravity {:.6g}; input {:.6g}, dissipated {:.6g}\n",
      energy.kinetic, energy.elastic, energy.gravity, energy.input, energy.dissipation);
}

std::string format_loose(const std::string& unknown) {
  return fmt::format("  nothing holds {}, and nothing loads it: it stays as drawn\n", unknown);
}

std::string format_start(const StartReport& start) {
  std::string text;
  if (start.largest_displacement > 1e-9 || start.largest_rotation > 1e-9)
    text += start.displaced_node.empty()
                ? fmt::format("  assembly turned nodes in place: largest rotation {:.3g} rad\n", start.largest_rotation)
                : fmt::format("  assembly moved node '{}' by {:.3g} m; largest rotation {:.3g} rad\n",
                              start.displaced_node, start.largest_displacement, start.largest_rotation);
  text += format_moved(start);
  if (start.settled > 0)
    text += fmt::format("  static equilibrium moved node '{}' by {:.3g} m\n", start.settled_node, start.settled);
  if (start.unstable > 0)
    text += fmt::format(
        "  the static equilibrium is unstable: its stiffness is negative along {}{}. The slightest disturbance makes "
        "the mechanism leave it\n",
        counted(start.unstable, "motion"),
        start.unstable_motion.empty() ? "" : fmt::format(", most at {}", start.unstable_motion));
  if (!start.loose.empty()) text += format_loose(start.loose);
  if (!start.held.empty()) text += fmt::format("  {}\n", describe_held(start.held));
  if (start.balanced > 1e-9)
    text += fmt::format(
        "  node '{}', which has no mass, was not in the equilibrium of its forces: it was moved there, by {:.3g} m\n",
        start.balanced_node, start.balanced);
  if (!start.unbalanced.empty())
    text += fmt::format(
        "  {}: it has no mass, and no position near by where its forces are in equilibrium: it jumps in the first "
        "steps, with meaningless velocities\n",
        start.unbalanced);
  if (start.velocity_change > 1e-9 || start.angular_change > 1e-9) {
    const std::string linear = start.velocity_change > 1e-9 ? fmt::format("{:.3g} m/s", start.velocity_change) : "",
                      angular = start.angular_change > 1e-9 ? fmt::format("{:.3g} rad/s", start.angular_change) : "";
    text += fmt::format("  start velocities were changed by up to {}{}{} to satisfy joints and drives\n", linear,
                        linear.empty() || angular.empty() ? "" : " and ", angular);
  }
  for (const CarriedPart& part : start.carried) text += format_carried(part);
  if (!start.following.empty())
    text += fmt::format("  start rates that follow from others, and agree with them: {}\n",
                        fmt::join(start.following, ", "));
  return text;
}

std::string describe_not_unique(const NotUnique& found) {
  std::vector<std::string> parts;
  std::size_t count = 0;
  const auto add = [&](const char* one, const char* several, const std::vector<std::string>& names) {
    if (!names.empty())
      parts.push_back(fmt::format("the {} '{}'", names.size() == 1 ? one : several, fmt::join(names, "', '")));
    count += names.size();
  };
  add("reaction of joint", "reactions of joints", found.joints);
  add("force of drive", "forces of drives", found.drives);
  add("force of the lock of joint", "forces of the locks of joints", found.locked);
  if (parts.empty()) return {};
  std::string text = parts.back();
  parts.pop_back();
  if (!parts.empty()) text = fmt::format("{} and {}", fmt::join(parts, ", "), text);
  return fmt::format("{} {} not unique: the smallest {} reported", text, count == 1 ? "is" : "are",
                     count == 1 ? "is" : "are");
}

std::string describe_loose(const System& system) {
  constexpr std::size_t most = 5;
  const std::vector<int> nodes = loose_parts(system);
  if (nodes.empty()) return {};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(most, nodes.size()); ++k) names.push_back(system.model().node(nodes[k]).name);
  return fmt::format("joined to nothing that is held: {} '{}'{}",
                     nodes.size() == 1 ? "the part of node" : "the parts of nodes", fmt::join(names, "', '"),
                     nodes.size() > most ? fmt::format(" and {} more", nodes.size() - most) : "");
}

std::string format_mobility(const Session& session) {
  const Mobility& mobility = session.mobility();
  std::string text = fmt::format("  {}", counted(mobility.degrees, "degree of freedom", "degrees of freedom"));
  if (session.system().switches())
    text += " at the start, where some constraints can let go (locks, drives, joints that stick)";
  else if (mobility.degrees == 0)
    text += ": nothing moves but by drives and prescribed motions";
  text += "\n";
  if (const std::string loose = describe_loose(session.system()); !loose.empty()) text += fmt::format("  {}\n", loose);
  for (const std::string& name : session.redundant()) text += fmt::format("  redundant: {}; set aside\n", name);
  for (const std::string& name : mobility.nearly_redundant)
    text += fmt::format(
        "  nearly redundant: {} differs from what others hold by less than a thousandth; as it is, it takes a degree "
        "of "
        "freedom away and may bear any force: are axes and positions exact?\n",
        name);
  if (const NotUnique found = find_not_unique(session.system(), session.acting(), session.state()); !found.none())
    text += fmt::format(
        "  {}{}\n", describe_not_unique(found),
        session.system().reads_reactions() ? ", and forces that depend on them (friction) follow from these" : "");
  return text;
}

std::string format_steps(long steps, long iterations, long records) {
  return fmt::format("  {}, {:.2f} Newton iterations per step, {} recorded", counted(steps, "step"),
                     static_cast<double>(iterations) / static_cast<double>(steps), counted(records, "row"));
}

namespace {

/// Names the motion about which small motions were computed.
std::string format_about(const LinearisedSetting::Turning& turning) {
  if (turning.unresolved > 0)
    return fmt::format(
        "with up to {} harmonics not all motions about it were found: modes are those about the mean state, around "
        "which frequencies change over a turn",
        turning.unresolved);
  std::string text = "motions are about this periodic motion";
  if (turning.unresolved_at.empty()) return text;
  const double fastest = *std::max_element(turning.unresolved_at.begin(), turning.unresolved_at.end(),
                                           [](double a, double b) { return std::abs(a) < std::abs(b); });
  return text + fmt::format(
                    ", but at {}, the fastest {:.6g} rad/s, not all of them were found: modes there are those about "
                    "the mean state",
                    counted(turning.unresolved_at.size(), "rate"), fastest);
}

std::string format_vibration(const LinearisedSetting::Turning& turning) {
  if (turning.mean)
    return "  motions are about the mean state: vibrations by gravity across the axis and by unbalance are left out\n";
  if (turning.orbit_harmonics == 0) return "";
  return fmt::format(
      "  gravity across the axis and unbalance shake the mechanism periodically: node '{}' moves up to {:.3g} m from "
      "its place in the mean state, nodes turn up to {:.3g} rad ({} harmonics); {}\n",
      turning.moved, turning.displacement, turning.rotation, turning.orbit_harmonics, format_about(turning));
}

std::string format_turning(const LinearisedSetting::Turning& turning) {
  std::string text =
      fmt::format("  what is behind {} turns at {:.6g} rad/s, the rest stands still\n", turning.joint, turning.rate);
  if (turning.rate == 0) return text;
  text += format_vibration(turning);
  switch (turning.periodicity) {
    case Periodicity::negligible:
      return text + "  the rate is negligible compared with all frequencies: they are those at rest, as drawn\n";
    case Periodicity::constant:
      return text +
             "  the equations are constant in axes that turn with it: frequencies of its motions are those seen from "
             "there, of all others those seen from what stands still\n";
    case Periodicity::multiblade:
      return text +
             "  the equations are constant in multiblade coordinates (the rotor is the same in all directions): "
             "frequencies are those seen from what stands still\n";
    default:
      return text +
             fmt::format(
                 "  the equations are periodic in any axes: Floquet exponents with {} harmonics of the rotation, "
                 "accurate to about {:.1g}; frequencies that differ by multiples of the rate belong to the "
                 "same motion\n",
                 turning.harmonics, turning.change);
  }
}

}  // namespace

std::string format_setting(const LinearisedSetting& setting, const char* what) {
  std::string text = setting.turning ? format_turning(*setting.turning) : format_axes(setting, what);
  if (!setting.delays.empty())
    text += fmt::format("  warning: {} are those of the equations without delays: {}\n", what,
                        fmt::join(setting.delays, ", "));
  return text;
}

}  // namespace bielle::mechanism
