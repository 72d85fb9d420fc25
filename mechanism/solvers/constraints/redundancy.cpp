#include "mechanism/solvers/constraints/redundancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/SparseCore>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/math/rank.hpp"
#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the longest lever arm at which a component's constraints act on its nodes [m]: the ratio of rotations to
/// translations in its columns of B^T, as sums of squares over all columns that have forces. It is independent of
/// units, the position of the origin, and the axes of the component and the nodes. If all arms are only rounding errors
/// of positions, translations and rotations do not mix, and the length is arbitrary.
double longest_arm(const System& system, const std::vector<double>& values, double positions) {
  constexpr double rounding = 1e-12;
  const SparsePattern& pattern = system.pattern();
  const int first = system.size() - system.multipliers();
  double area = 0;
  for (const Slots& slots : system.slots()) {
    double forces = 0, moments = 0;
    for (int column = first + slots.multiplier_begin; column < first + slots.multiplier_begin + slots.multipliers;
         ++column) {
      double force = 0, moment = 0;
      for (int k = pattern.column_start()[static_cast<std::size_t>(column)];
           k < pattern.column_start()[static_cast<std::size_t>(column) + 1]; ++k) {
        const int row = pattern.row()[static_cast<std::size_t>(k)];
        if (row >= system.dofs()) continue;
        const double square = values[static_cast<std::size_t>(k)] * values[static_cast<std::size_t>(k)];
        if (system.kind(row) == Kind::translation) force += square;
        if (system.kind(row) == Kind::rotation) moment += square;
      }
      // Directions have length one. If all nodes of a model are at one point, there is no size with which moments can
      // be compared.
      constexpr double direction = 1e-6;
      if (!(std::sqrt(force) > direction) && !(std::sqrt(force) * positions > rounding * std::sqrt(moment))) continue;
      forces += force;
      moments += moment;
    }
    if (forces > 0) area = std::max(area, moments / forces);
  }
  const double arm = std::sqrt(area);
  return arm > rounding * positions ? arm : positions;
}

}  // namespace

std::vector<int> find_redundant(const System& system, const Environment& environment, const State& state,
                                double least) {
  if (system.multipliers() == 0) return {};
  std::vector<double> values;
  system.tangent(state, environment, TangentWeights{0, 0, 0, 0, 1, true}, nullptr, values);
  const double positions = model_length(state), length = longest_arm(system, values, positions);
  const SparsePattern& pattern = system.pattern();
  const int first = system.size() - system.multipliers();
  std::vector<Eigen::Triplet<double>> entries;
  // The last ones of dependent columns are found. Constraints that yield to others therefore come last.
  std::vector<int> order(static_cast<std::size_t>(system.multipliers())), place(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(), [&](int m) { return !system.yields(m); });
  for (int k = 0; k < system.multipliers(); ++k)
    place[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])] = k;
  for (int m = 0; m < system.multipliers(); ++m) {
    const auto begin = static_cast<std::size_t>(pattern.column_start()[static_cast<std::size_t>(first + m)]);
    const auto end = static_cast<std::size_t>(pattern.column_start()[static_cast<std::size_t>(first + m + 1)]);
    double norm = 0;
    const auto scaled = [&](std::size_t k) {
      // Increments of translations are divided by the arm.
      return values[k] * (system.kind(pattern.row()[k]) == Kind::translation ? length : 1.0);
    };
    for (std::size_t k = begin; k < end; ++k) norm += scaled(k) * scaled(k);
    norm = std::sqrt(norm);
    for (std::size_t k = begin; k < end; ++k)
      if (norm > 0 && pattern.row()[k] < first && values[k] != 0)
        entries.emplace_back(pattern.row()[k], place[static_cast<std::size_t>(m)], scaled(k) / norm);
  }
  Eigen::SparseMatrix<double> transposed(first, system.multipliers());
  transposed.setFromTriplets(entries.begin(), entries.end());
  // The tolerance is far above rounding (of positions relative to the arms), and far below the errors of a nearly
  // planar loop.
  const double tolerance = std::max({1e-9, least, 1e3 * std::numeric_limits<double>::epsilon() * positions / length});
  std::vector<int> dependent = dependent_columns(transposed, tolerance);
  for (int& column : dependent) column = order[static_cast<std::size_t>(column)];
  std::sort(dependent.begin(), dependent.end());
  // A constraint that is switched off has no entries; it is not redundant.
  if (!state.idle.empty())
    std::erase_if(dependent, [&](int m) { return state.idle[static_cast<std::size_t>(m)] == Idle::switched_off; });
  return dependent;
}

State with_redundant(const System& system, const State& state) {
  State whole = state;
  if (whole.idle.empty()) whole.idle.assign(static_cast<std::size_t>(system.multipliers()), Idle::active);
  for (char& idle : whole.idle)
    if (idle == Idle::redundant) idle = Idle::active;
  return whole;
}

double redundancy_arm(const System& system, const Environment& environment, const State& state) {
  std::vector<double> values;
  system.tangent(with_redundant(system, state), environment, TangentWeights{0, 0, 0, 0, 1, true}, nullptr, values);
  return longest_arm(system, values, model_length(state));
}

void set_redundant_aside(const System& system, const Environment& environment, State& state) {
  if (!system.switches()) return;
  for (char& idle : state.idle)
    if (idle == Idle::redundant) idle = Idle::active;
  for (const int multiplier : find_redundant(system, environment, state)) {
    state.idle[static_cast<std::size_t>(multiplier)] = Idle::redundant;
    state.multiplier[multiplier] = 0;
  }
}

std::vector<int> take_out_redundant(System& system, const Environment& environment, State& state) {
  if (!system.switches()) {
    const std::vector<int> redundant = find_redundant(system, environment, state);
    system.set_aside(redundant);
    return redundant;
  }
  system.begin_branch(state, environment);
  set_redundant_aside(system, environment, state);
  std::vector<int> redundant;
  system.for_each_redundant(state, [&](int multiplier) { redundant.push_back(multiplier); });
  return redundant;
}

namespace {

/// Returns constraints that are redundant to within `least`, and were not when redundant ones were determined.
std::vector<int> newly_redundant(const System& system, const Environment& environment, const State& state,
                                 double least) {
  std::vector<int> repeating = find_redundant(system, environment, state, least);
  std::vector<int> known;
  system.for_each_redundant(state, [&](int multiplier) { known.push_back(multiplier); });
  // The last of several dependent rows may be another one than at the start; only a larger number is new.
  if (repeating.size() <= known.size()) return {};
  std::erase_if(repeating, [&](int multiplier) { return std::binary_search(known.begin(), known.end(), multiplier); });
  return repeating;
}

}  // namespace

Mobility count_mobility(const System& system, const Environment& environment, const State& state) {
  constexpr double near = 1e-3;
  Mobility mobility;
  mobility.independent = system.multipliers();
  system.for_each_idle(state, [&](int) { --mobility.independent; });
  mobility.degrees = system.dofs() - mobility.independent;
  mobility.nearly_redundant = name_constraints(system, newly_redundant(system, environment, state, near));
  return mobility;
}

std::string describe_singularity(const System& system, const Environment& environment, const State& state) {
  constexpr double near = 0.02;
  const std::vector<int> repeating = newly_redundant(system, environment, state, near);
  if (repeating.empty()) return {};
  const std::vector<std::string> names = name_constraints(system, repeating);
  return fmt::format(
      "the mechanism is at or near a singular position there (links in line, a dead centre): {} nearly repeat{} what "
      "other constraints hold, and the motion may branch or jam",
      fmt::join(names, "; "), repeating.size() == 1 ? "s" : "");
}

namespace {

/// Returns the member that a multiplier belongs to.
std::size_t owner_of(const System& system, int multiplier) {
  const std::vector<Slots>& slots = system.slots();
  // Members without multipliers have the same begin as the next one.
  const auto behind = std::upper_bound(slots.begin(), slots.end(), multiplier,
                                       [](int wanted, const Slots& each) { return wanted < each.multiplier_begin; });
  return static_cast<std::size_t>(behind - slots.begin()) - 1;
}

}  // namespace

std::vector<std::string> name_constraints(const System& system, const std::vector<int>& multipliers) {
  const int first = system.size() - system.multipliers();
  std::vector<std::string> result;
  for (std::size_t k = 0; k < multipliers.size();) {
    const Slots& slots = system.slots()[owner_of(system, multipliers[k])];
    const int end = slots.multiplier_begin + slots.multipliers;
    std::string names, owner;
    int count = 0;
    for (; k < multipliers.size() && multipliers[k] < end; ++k, ++count) {
      const std::string name = system.unknown_name(first + multipliers[k]);  // "x of joint 'crank'"
      const std::size_t of = name.find(" of ");
      names += (count == 0 ? "" : ", ") + name.substr(0, of);
      owner = name.substr(of);
    }
    result.push_back(names + owner + (count == slots.multipliers ? " (all that it holds)" : ""));
  }
  return result;
}

namespace {

/// Returns whether fewer constraints are redundant after a small motion along a direction that the other constraints
/// permit: the mechanism is then in a singular position, for example with links in line.
bool stands_in_singular_position(const System& system, const Environment& environment, const State& state) {
  // The motion satisfies constraints to second order: after a motion of 1e-3, permanently redundant constraints are
  // still dependent to 1e-6, and those that are redundant only here to 1e-3.
  constexpr double part = 1e-3, least = 3e-5;
  if (system.dofs() == 0) return false;
  VectorX v(system.dofs());
  for (Eigen::Index k = 0; k < v.size(); ++k)
    v[k] = std::sin(1 + 1.7 * static_cast<double>(k));  // the direction is not aligned with any axis
  try {
    State moving = state;
    system.set_rates(moving, v, VectorX::Zero(v.size()));
    VectorX rates(system.multipliers()), unused(system.multipliers());
    system.constraint_rates(moving, environment, rates, unused);
    VectorX still(system.multipliers());
    system.set_rates(moving, VectorX::Zero(v.size()), VectorX::Zero(v.size()));
    system.constraint_rates(moving, environment, still, unused);
    KktMatrix saddle(system);
    saddle.factor(environment, state);
    VectorX r = VectorX::Zero(system.size()), change(system.size());
    r.tail(system.multipliers()) = rates - still;  // the prescribed rates of drives are removed
    system.for_each_redundant(state, [&](int multiplier) { r[system.size() - system.multipliers() + multiplier] = 0; });
    saddle.solve(r, change);
    v += change.head(system.dofs());
  } catch (const ComputationError&) {
    return false;  // there is no motion
  }
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return false;
  v *= part / largest;
  for (int k = 0; k < system.dofs(); ++k)
    if (system.kind(k) == Kind::translation) v[k] *= model_extent(state);
  State moved = state;
  system.displace(moved, state, v);
  std::size_t known = 0;
  system.for_each_redundant(state, [&](int) { ++known; });
  return find_redundant(system, environment, with_redundant(system, moved), least).size() < known;
}

}  // namespace

std::string describe_singular_start(const System& system, const Environment& environment, const State& state) {
  std::vector<int> redundant;
  system.for_each_redundant(state, [&](int multiplier) { redundant.push_back(multiplier); });
  if (redundant.empty() || !stands_in_singular_position(system, environment, state)) return {};
  return fmt::format(
      "the mechanism starts in a singular position (links in line, a dead centre): {} only look{} redundant there, and "
      "how it leaves that position is open; start from another one, or drive another joint",
      fmt::join(name_constraints(system, redundant), "; "), redundant.size() == 1 ? "s" : "");
}

void check_set_aside(const System& system, const Environment& environment, const State& state) {
  if (system.set_aside().empty() && state.idle.empty()) return;
  // Rounding and the errors of Newton's method are far smaller, and a contradiction exceeds this tolerance at once.
  constexpr double tolerance = 1e-6;
  std::size_t evaluated = system.slots().size();
  double length = 0;  // computed when it is first needed
  VectorX r;
  system.for_each_redundant(state, [&](int multiplier) {
    const std::size_t member = owner_of(system, multiplier);
    const Slots& slots = system.slots()[member];
    if (member != evaluated) {
      r.setZero(slots.size());
      system.model().members()[member].component->add_residual(LocalState(state, slots, environment), r);
      evaluated = member;
    }
    const int row = multiplier - slots.multiplier_begin;
    const double violation = r[slots.multiplier_row() + row];
    if (violation == 0) return;
    if (length == 0) length = model_length(state);
    if (std::abs(violation) <= tolerance * constraint_size(system, environment, state, member, row, length)) return;
    const int equation = system.size() - system.multipliers() + multiplier;
    const char* why = stands_in_singular_position(system, environment, state)
                          ? "the mechanism stands in a singular position (links in line, a dead centre), which "
                            "cannot be left by this constraint: start from another one, or drive another joint"
                          : "it contradicts the joints, locks and drives before it";
    throw ComputationError(
        fmt::format("t = {:.6g} s: {} looked redundant and was set aside, but is violated by {:.3g} {}: {}", state.time,
                    system.equation_name(equation), violation, system.equation_units(equation), why));
  });
}

}  // namespace bielle::mechanism
