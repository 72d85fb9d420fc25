#include "mechanism/analyses/mode_names.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/analyses/mode_groups.hpp"
#include "mechanism/analyses/mode_motion.hpp"

namespace bielle::mechanism {
namespace {

constexpr const char* coupled = "coupled mode";       // more than two parts share the energy
constexpr const char* rigid_motion = "rigid motion";  // several rigid modes have no unique shapes

/// Returns the name of a mode's part: the group whose deformation has most of the energy; otherwise the group with most
/// of all energy; otherwise the two groups that have most of it together, with a third one if its energy equals that of
/// the second. A mode without such groups is coupled.
/// @param one  set to the group if it is a single one
std::string main_part(const std::vector<ModeGroup>& groups, Eigen::Index mode, const ModeGroup*& one) {
  std::vector<const ModeGroup*> sorted;
  double whole = 0, kinetic = 0;
  for (const ModeGroup& group : groups) {
    sorted.push_back(&group);
    whole += group.energy[mode];
    kinetic += group.kinetic[mode];
  }
  if (sorted.empty() || !(whole > 0)) return {};
  // Averaged over a period, the whole potential energy equals the kinetic energy.
  for (const ModeGroup* group : sorted)
    if (group->deformation[mode] >= mode_share * kinetic && (!one || group->deformation[mode] > one->deformation[mode]))
      one = group;
  if (one) return one->name;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const ModeGroup* a, const ModeGroup* b) { return a->energy[mode] > b->energy[mode]; });
  if (sorted[0]->energy[mode] >= mode_share * whole) {
    one = sorted[0];
    return one->name;
  }
  if (sorted[0]->energy[mode] + sorted[1]->energy[mode] < mode_share * whole) return coupled;
  // Equal parts are named together, because rounding errors would decide between them.
  constexpr double equal = 0.99;
  std::vector<std::string> names = {sorted[0]->name, sorted[1]->name};
  for (std::size_t k = 2; k < sorted.size() && sorted[k]->energy[mode] >= equal * sorted[1]->energy[mode]; ++k)
    names.push_back(sorted[k]->name);
  if (names.size() > 3) return coupled;
  std::sort(names.begin(), names.end());
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::string ordinal(int number) {
  const bool teen = number % 100 / 10 == 1;
  const char* const ending[] = {"th", "st", "nd", "rd"};
  return fmt::format("{}{}", number, teen || number % 10 > 3 ? "th" : ending[number % 10]);
}

bool oscillates(const ModeName& mode) { return mode.s.imag() != 0; }

/// Place of a mode among the modes of its part with the same exponent.
struct EqualModes {
  std::size_t set = 0, place = 0, count = 1;
};

/// Removes the words that the shapes of equal modes do not determine.
std::vector<EqualModes> merge_equal(std::vector<ModeName>& modes) {
  constexpr double equal = 1e-6;  // relative
  std::vector<EqualModes> places(modes.size());
  std::vector<char> done(modes.size(), 0);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (done[i] != 0) continue;
    places[i].set = i;
    if (modes[i].part.empty()) continue;
    std::vector<std::size_t> all;
    for (std::size_t j = i; j < modes.size(); ++j) {
      const bool rigid = modes[i].kind == ModeKind::rigid && modes[j].kind == ModeKind::rigid;
      const bool same = modes[i].kind == modes[j].kind && modes[i].part == modes[j].part &&
                        std::abs(modes[i].s - modes[j].s) <= equal * std::abs(modes[i].s);
      if (done[j] == 0 && !modes[j].part.empty() && (rigid || same)) all.push_back(j);
    }
    const ModeName first = modes[i];
    for (std::size_t k = 0; k < all.size(); ++k) {
      done[all[k]] = 1;
      places[all[k]] = {i, k, all.size()};
    }
    if (all.size() == 1) continue;
    const auto all_have = [&](std::string ModeName::*word) {
      return std::all_of(all.begin(), all.end(), [&](std::size_t j) { return modes[j].*word == first.*word; });
    };
    const std::string family = all_have(&ModeName::family) ? first.family : "";
    const std::string motion = all_have(&ModeName::motion) ? first.motion : family;
    const std::string pattern = all_have(&ModeName::pattern) ? first.pattern : "";
    for (const std::size_t j : all) {
      modes[j].motion = motion;
      modes[j].pattern = pattern;
      modes[j].rate = first.rate;
      if (first.kind != ModeKind::rigid) continue;
      modes[j].part = rigid_motion;
      modes[j].motion.clear();
      modes[j].pattern.clear();
    }
  }
  return places;
}

/// Returns the name without its number.
std::string base_name(const ModeName& mode) {
  if (mode.part.empty()) return {};
  std::string name = mode.part;
  if (!mode.motion.empty()) name += " " + mode.motion;
  if (!mode.pattern.empty()) name += ", " + mode.pattern;
  const bool tells = mode.kind == ModeKind::rigid ? mode.part != rigid_motion : !oscillates(mode);
  if (tells) name += fmt::format(", {}", mode_kind_name(mode.kind));
  return name;
}

/// Returns the least order of a mode of blades. There are as many modes of each order as there are blades; some of
/// these may have mixed patterns, and therefore other names.
int order_of_copies(const std::vector<ModeName>& modes, std::size_t k) {
  if (modes[k].copies == 1) return 1;
  int slower = 0;
  for (const ModeName& other : modes)
    if (other.part == modes[k].part && other.motion == modes[k].motion && other.kind == modes[k].kind &&
        other.rate < modes[k].rate)
      ++slower;
  return 1 + slower / modes[k].copies;
}

/// Numbers modes with the same name by rising rate; equal modes count as one.
std::vector<int> numbers_of(const std::vector<ModeName>& modes, const std::vector<std::string>& names,
                            const std::vector<EqualModes>& equal) {
  std::vector<std::size_t> ascending(modes.size());
  std::iota(ascending.begin(), ascending.end(), std::size_t{0});
  std::stable_sort(ascending.begin(), ascending.end(),
                   [&](std::size_t a, std::size_t b) { return modes[a].rate < modes[b].rate; });
  std::map<std::string, int> last;
  std::vector<int> numbers(modes.size(), 0);
  for (const std::size_t k : ascending)
    numbers[k] = equal[k].place > 0 ? numbers[equal[k].set]
                                    : last[names[k]] = std::max(last[names[k]] + 1, order_of_copies(modes, k));
  return numbers;
}

}  // namespace

std::vector<ModeName> describe_modes(const System& system, const ModesReport& report) {
  const std::vector<ModeGroup> groups = mode_groups(system, report);
  const MotionWords words(system, report);
  std::vector<ModeName> modes;
  for (std::size_t k = 0; k < report.found.modes.size(); ++k) {
    ModeName& name = modes.emplace_back();
    const Mode& mode = report.found.modes[k];
    name.s = mode.s;
    name.kind = mode.kind;
    name.rate = std::abs(mode.s);
    const ModeGroup* group = nullptr;
    name.part = main_part(groups, static_cast<Eigen::Index>(k), group);
    name.numbered = name.part == coupled;
    if (!group) continue;
    ModeMotion motion = words(*group, k);
    name.family = std::move(motion.family);
    name.motion = std::move(motion.motion);
    name.pattern = std::move(motion.pattern);
    name.copies = motion.copies;
    name.numbered = group->flexible && mode.kind != ModeKind::rigid && oscillates(name);
  }
  return modes;
}

std::vector<std::string> full_names(std::vector<ModeName> modes, bool from_slowest) {
  const std::vector<EqualModes> equal = merge_equal(modes);
  std::vector<std::string> names;
  for (const ModeName& mode : modes) names.push_back(base_name(mode));
  const std::vector<int> numbers = numbers_of(modes, names, equal);
  std::vector<std::string> full = names;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    if (names[k].empty()) continue;
    if (modes[k].kind != ModeKind::rigid) {
      bool alone = true;
      for (std::size_t j = 0; j < modes.size(); ++j)
        alone = alone && (names[j] != names[k] || equal[j].set == equal[k].set);
      if (from_slowest && (modes[k].numbered || numbers[k] > 1))
        full[k] = fmt::format("{} {}", ordinal(numbers[k]), full[k]);
      if (!from_slowest && !alone)
        full[k] += fmt::format(", at {:.6g} Hz", std::abs(modes[k].s) / (2 * std::numbers::pi));
    }
    if (equal[k].count > 1) full[k] += fmt::format(", {} of {}", equal[k].place + 1, equal[k].count);
  }
  return full;
}

}  // namespace bielle::mechanism
