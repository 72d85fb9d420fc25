#include "mechanism/solvers/start/unclosed.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/model/assembly_branch.hpp"
#include "mechanism/solvers/start/closing_newton.hpp"

namespace bielle::mechanism {
namespace {

constexpr double counts = 1e-3;      // fraction of the largest gap or force that counts as a contradiction
constexpr double negligible = 1e-6;  // gap relative to the mechanism's size

/// Owner of rows: a member, or a condition.
struct Owner {
  int first_row = 0, rows = 0;
  const Member* member = nullptr;  ///< nullptr: a condition
};

std::vector<Owner> owners_of(const ClosingEquations& equations) {
  const System& system = equations.system();
  std::vector<Owner> owners;
  for (std::size_t m = 0; m < system.slots().size(); ++m)
    if (const Slots& slots = system.slots()[m]; slots.multipliers > 0)
      owners.push_back({slots.multiplier_begin, slots.multipliers, &system.model().members()[m]});
  for (int row = system.multipliers(); row < equations.rows(); ++row) owners.push_back({row, 1, nullptr});
  return owners;
}

/// Returns the largest gap of an owner, or the largest force in the same measure.
double largest(const ClosingEquations& equations, const Owner& owner, const VectorX& values) {
  double result = 0;
  for (int row = owner.first_row; row < owner.first_row + owner.rows; ++row)
    result = std::max(result, equations.gap(row, values[row]));
  return result;
}

std::string angle_text(double angle) { return fmt::format("{:.4g} degrees", angle * 180 / M_PI); }

std::string quantity(double value, const std::string& units) {
  return units == "rad" ? angle_text(std::abs(value)) : fmt::format("{:.4g} {}", std::abs(value), units);
}

/// Returns "0.5 m and 3.2 degrees".
std::string gap_text(const ClosingEquations& equations, const Owner& owner, const VectorX& gaps, const State& state) {
  const System& system = equations.system();
  const int first = system.size() - system.multipliers();
  double distance = 0, angle = 0;
  std::string other;
  for (int row = owner.first_row; row < owner.first_row + owner.rows; ++row) {
    const std::string units = system.equation_units(first + row);
    if (units == "m")
      distance += gaps[row] * gaps[row];
    else if (units == "rad")
      angle += gaps[row] * gaps[row];
    else if (gaps[row] != 0)
      other = quantity(gaps[row], units);
  }
  distance = std::sqrt(distance);
  angle = std::sqrt(angle);
  const std::size_t m = static_cast<std::size_t>(owner.member - system.model().members().data());
  if (const auto* branch = dynamic_cast<const AssemblyBranch*>(owner.member->component.get()); branch && angle > 0)
    if (const double turn = branch->misalignment(LocalState(state, system.slots()[m], equations.environment())).norm();
        turn > 0)
      angle = turn;
  std::vector<std::string> parts;
  if (distance > negligible * equations.half_extent()) parts.push_back(fmt::format("{:.4g} m", distance));
  if (angle > negligible) parts.push_back(angle_text(angle));
  if (!other.empty()) parts.push_back(other);
  return parts.empty() ? "less than the rounding error" : fmt::format("{}", fmt::join(parts, " and "));
}

std::string condition_text(const ClosingEquations& equations, int row) {
  const CoordinateCondition& condition = equations.condition(row);
  const StartCoordinate coordinate = start_coordinate(equations.system(), condition);
  const std::string name = coordinate_name(equations.system(), condition.member, coordinate);
  return condition.kept ? fmt::format("the {} that is kept", name)
                        : fmt::format("the start value {:.6g} {} of {}", *condition.value, coordinate.units, name);
}

/// Chooses the owner that stays open. A start value has priority, because the parts can be assembled without it;
/// otherwise the last owner in the file is chosen.
const Owner* choose_opening(const ClosingEquations& equations, const std::vector<Owner>& owners, const VectorX& gaps) {
  double most = 0;
  for (const Owner& owner : owners) most = std::max(most, largest(equations, owner, gaps));
  const Owner *opening = nullptr, *kept = nullptr;
  for (const Owner& owner : owners) {
    if (largest(equations, owner, gaps) < counts * most) continue;
    if (!owner.member && equations.condition(owner.first_row).kept)
      kept = &owner;
    else
      opening = &owner;
  }
  return opening ? opening : kept;
}

/// Describes the members with forces on the opening, and the kept nodes with forces.
std::string describe_others(const ClosingEquations& equations, const std::vector<Owner>& owners, const Owner& opening,
                            const VectorX& forces) {
  const System& system = equations.system();
  // Forces are divided by the weights of their rows, like gaps.
  VectorX measured = forces;
  for (int row = 0; row < equations.rows(); ++row) measured[row] /= equations.weight(row);
  double most = 0;
  for (const Owner& owner : owners) most = std::max(most, largest(equations, owner, measured));
  std::vector<std::string> others, kept;
  for (const Owner& owner : owners) {
    if (&owner == &opening || largest(equations, owner, measured) < counts * most) continue;
    if (owner.member)
      others.push_back(describe(*owner.member));
    else
      (equations.condition(owner.first_row).kept ? kept : others).push_back(condition_text(equations, owner.first_row));
  }
  const VectorX pulls = equations.forces_on_dofs(forces);
  for (const int node : equations.conditions().kept_nodes) {
    const Carry* carry = system.kinematics().carry(node);
    const NodeFreedom& freedom = system.kinematics().freedom(carry ? carry->carrier : node);
    double pull = 0;
    for (int i = freedom.begin; i < freedom.begin + freedom.count; ++i)
      pull = std::max(pull, std::abs(pulls[i]) / (system.kind(i) == Kind::rotation ? equations.half_extent() : 1.0));
    if (pull > counts * most) kept.push_back(fmt::format("node '{}'", system.model().node(node).name));
  }
  constexpr std::size_t shown = 12;
  const auto listed = [&](std::vector<std::string>& names) {
    const std::size_t count = names.size();
    if (count > shown) names.resize(shown);
    return fmt::format("{}{}", fmt::join(names, ", "), count > shown ? fmt::format(" and {} more", count - shown) : "");
  };
  std::string text;
  if (!others.empty()) text += fmt::format("; it disagrees with {}", listed(others));
  if (!kept.empty()) text += fmt::format("; kept, and in the way: {}", listed(kept));
  return text;
}

}  // namespace

Unclosed explain_unclosed(ClosingEquations& equations, State& state) {
  const std::vector<Owner> owners = owners_of(equations);
  const Owner* opening = choose_opening(equations, owners, equations.measure(state).values);
  if (!opening) return {true, {}};
  std::vector<bool> soft(static_cast<std::size_t>(equations.rows()), false);
  std::fill_n(soft.begin() + opening->first_row, opening->rows, true);
  const VectorX forces = gather_gaps(equations, soft, state);
  const VectorX gaps = equations.measure(state).values;
  if (!(largest(equations, *opening, gaps) > negligible * equations.half_extent())) return {true, {}};
  std::string text;
  if (!opening->member) {
    const CoordinateCondition& condition = equations.condition(opening->first_row);
    const StartCoordinate coordinate = start_coordinate(equations.system(), condition);
    text =
        fmt::format("the {} stays {} away from {}", coordinate_name(equations.system(), condition.member, coordinate),
                    quantity(gaps[opening->first_row], coordinate.units),
                    condition.kept ? "where it is kept"
                                   : fmt::format("its start value {:.6g} {}", *condition.value, coordinate.units));
  } else if (opening->member->entry.section == Section::drives) {
    text = fmt::format("{} stays {} away from what it prescribes", describe(*opening->member),
                       gap_text(equations, *opening, gaps, state));
  } else {
    text = fmt::format("{} stays open by {}", describe(*opening->member), gap_text(equations, *opening, gaps, state));
  }
  return {false, text + " whatever the other parts do" + describe_others(equations, owners, *opening, forces)};
}

}  // namespace bielle::mechanism
