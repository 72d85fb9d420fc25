#include "mechanism/solvers/start/acceleration_refusals.hpp"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the names of the components that read the reactions of the multiplier's owner; if there are none, or no
/// multiplier is given, those of all components that read any reactions.
std::string names_of_readers(const System& system, int multiplier) {
  std::vector<std::string> names, all;
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Member& member = system.model().members()[m];
    Declaration declaration;
    member.component->declare(declaration);
    if (!declaration.reads_reactions || declaration.passive) continue;
    const std::string name = describe(member);
    if (all.empty() || all.back() != name) all.push_back(name);
    for (const Slots* read : system.slots()[m].references)
      if (multiplier >= read->multiplier_begin && multiplier < read->multiplier_begin + read->multipliers &&
          (names.empty() || names.back() != name))
        names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names.empty() ? all : names, ", "));
}

std::string advice(const System& system, int multiplier) {
  return fmt::format(
      "; those of {} (friction) are too strong for rigid parts in this position (Painleve's paradox): give a part or "
      "the contact some compliance, or make them weaker",
      names_of_readers(system, multiplier));
}

}  // namespace

std::string multiplier_name(const System& system, int multiplier) {
  return system.unknown_name(system.size() - system.multipliers() + multiplier);
}

void throw_ambiguous_accelerations(const System& system, double time, const std::string& how, int multiplier) {
  throw ComputationError(fmt::format(
      "t = {:.6g} s: forces that depend on reactions leave more than one solution for the accelerations: {}{}", time,
      how, advice(system, multiplier)));
}

void throw_no_accelerations(const System& system, double time, int worst, bool paradox) {
  const std::string where =
      worst < 0 ? std::string() : fmt::format(" (the search for {} did not settle)", multiplier_name(system, worst));
  if (paradox)
    throw ComputationError(
        fmt::format("t = {:.6g} s: forces that depend on reactions leave no solution for the accelerations{}{}", time,
                    where, advice(system, worst)));
  throw ComputationError(
      fmt::format("t = {:.6g} s: no accelerations and reactions were found{}, where forces of {} depend on reactions",
                  time, where, names_of_readers(system, worst)));
}

}  // namespace bielle::mechanism
