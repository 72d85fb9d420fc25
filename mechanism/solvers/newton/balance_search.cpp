#include "mechanism/solvers/newton/balance_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

BalanceSearch::BalanceSearch(const System& system) : system_(system) {
  const auto& members = system.model().members();
  for (std::size_t m = 0; m < members.size(); ++m)
    if (const auto* balance = dynamic_cast<const FlowBalance*>(members[m].component.get())) {
      const FlowBalance::Range range = balance->balance_range();
      balances_.push_back({system.slots()[m].first_order_begin + range.unknown, range});
    }
  const auto n = static_cast<Eigen::Index>(balances_.size());
  for (VectorX* vector : {&f_, &terms_, &y_, &d_}) vector->setZero(n);
  J_.setZero(n, n);
  if (n == 0) return;
  int largest = 0;
  for (std::size_t m = 0; m < members.size(); ++m) {
    Member member{m, {}, false};
    note_rows(system.slots()[m], 0, member);
    if (member.rows.empty()) continue;
    Declaration declaration;
    members[m].component->declare(declaration);
    if (declaration.passive) continue;
    member.has_tangent = declaration.stiffness;
    largest = std::max(largest, system.slots()[m].size());
    members_.push_back(std::move(member));
  }
  local_.setZero(largest);
}

/// Adds the balances among the first-order rows of a local vector, including those of its references.
/// @param row  first row of the slots' own local vector in it
void BalanceSearch::note_rows(const Slots& slots, int row, Member& member) const {
  for (std::size_t k = 0; k < balances_.size(); ++k) {
    const int own = balances_[k].unknown - slots.first_order_begin;
    if (own >= 0 && own < slots.first_orders)
      member.rows.emplace_back(row + slots.first_order_row() + own, static_cast<int>(k));
  }
  for (std::size_t k = 0; k < slots.references.size(); ++k)
    note_rows(*slots.references[k], row + slots.reference_rows[k], member);
}

void BalanceSearch::evaluate(const State& state, const Environment& environment, bool with_slopes) {
  f_.setZero();
  terms_.setZero();
  if (with_slopes) J_.setZero();
  for (const Member& member : members_) {
    if (!system_.is_active(state, member.number)) continue;
    const Slots& slots = system_.slots()[member.number];
    const Component& component = *system_.model().members()[member.number].component;
    const LocalState local(state, slots, environment);
    const int n = slots.size();
    local_.head(n).setZero();
    component.add_residual(local, local_.head(n));
    for (const auto& [row, k] : member.rows) {
      f_[k] += local_[row];
      terms_[k] += std::abs(local_[row]);
    }
    if (!with_slopes || !member.has_tangent) continue;
    K_.setZero(n, n);
    unused_.setZero(n, n);
    LocalTangent tangent{LocalMatrix(K_), LocalMatrix(unused_), LocalMatrix(unused_), true, false, false};
    component.add_tangent(local, tangent);
    for (const auto& [row, k] : member.rows)
      for (const auto& [column, l] : member.rows) J_(k, l) += K_(row, column);
  }
}

bool BalanceSearch::beyond_bounds(const State& state) const {
  return std::any_of(balances_.begin(), balances_.end(), [&](const Balance& each) {
    const double y = state.first_order[each.unknown];
    return y < each.range.least || y > each.range.most;
  });
}

/// Returns whether f is zero to 1e-12 of the flows, or to the rounding of the unknowns.
bool BalanceSearch::balanced() const {
  constexpr double accurate = 1e-12, rounding = 10 * std::numeric_limits<double>::epsilon();
  for (Eigen::Index i = 0; i < f_.size(); ++i) {
    const double rounded = J_.row(i).cwiseAbs().dot(y_.cwiseAbs());
    if (!(std::abs(f_[i]) <= accurate * terms_[i] + rounding * rounded)) return false;
  }
  return true;
}

/// @returns false if the balances decrease along the direction, which real balances do not
bool BalanceSearch::set_direction() {
  // The additions to the diagonal are far below values that change Newton's direction, and far above the rounding
  // errors of a group of junctions that are only joined with each other.
  constexpr double own = 1e-9, of_all = 1e-12;
  const double most = J_.cwiseAbs().maxCoeff();
  if (!std::isfinite(most) || most == 0) return false;
  J_.diagonal().array() += own * J_.diagonal().array().abs() + of_all * most;
  factors_.compute(J_);
  factors_.solve(-f_, d_);
  return d_.allFinite() && d_.dot(f_) < 0;
}

void BalanceSearch::move(State& state, double part) const {
  for (std::size_t k = 0; k < balances_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    state.first_order[balances_[k].unknown] = y_[i] + part * d_[i];
  }
}

/// Returns d . f. It is infinite if a component cannot be evaluated, so that the step becomes shorter.
double BalanceSearch::slope(State& state, const Environment& environment, double part) {
  move(state, part);
  try {
    evaluate(state, environment, false);
  } catch (const ComputationError&) {
    return infinity;
  }
  const double slope = d_.dot(f_);
  return std::isfinite(slope) ? slope : infinity;
}

/// Returns the fraction of the direction at which an unknown reaches one of its bounds. @param first  receives this
/// unknown
double BalanceSearch::longest_part(int& first) const {
  double longest = infinity;
  for (std::size_t k = 0; k < balances_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (d_[i] == 0) continue;
    const double part =
        std::max(0.0, ((d_[i] > 0 ? balances_[k].range.most : balances_[k].range.least) - y_[i]) / d_[i]);
    if (part >= longest) continue;
    longest = part;
    first = static_cast<int>(k);
  }
  return longest;
}

/// Moves along the direction until the slope has become small.
BalanceSearch::Way BalanceSearch::go(State& state, const Environment& environment) {
  constexpr double newton = 0.5, exact = 0.1;  // permitted fraction of the initial slope
  constexpr double growth = 8;
  const double before = std::abs(d_.dot(f_));
  int first = 0;
  const double longest = longest_part(first);
  double low = 0, part = std::min(1.0, longest), s = slope(state, environment, part);
  if (std::abs(s) <= newton * before) return Way::found;
  while (s < 0 && part < longest) {
    low = part;
    part = std::min(growth * part, longest);
    s = slope(state, environment, part);
    if (std::abs(s) <= exact * before) return Way::found;
  }
  if (!(s < 0)) return bracket(state, environment, low, part, exact * before);
  explain(first);
  return Way::blocked;
}

/// Bisects between `low`, with a slope below zero, and `high`, with a slope above zero.
BalanceSearch::Way BalanceSearch::bracket(State& state, const Environment& environment, double low, double high,
                                          double enough) {
  constexpr double nothing = 1e-3;  // [units of the unknowns]: smaller steps end the search
  constexpr int most = 200;
  const double least = nothing / std::max(d_.cwiseAbs().maxCoeff(), nothing);
  for (int k = 0; k < most; ++k) {
    const double begin = low > 0 ? low : least;
    if (high <= begin) break;
    const double part = high > 4 * begin ? std::sqrt(begin * high) : 0.5 * (begin + high);
    const double s = slope(state, environment, part);
    if (std::abs(s) <= enough) return Way::found;
    (s < 0 ? low : high) = part;
    if (high - low <= 1e-15 * high) return std::isfinite(s) ? Way::found : Way::refused;
  }
  return Way::refused;
}

/// Writes why there is no balance: every value up to the bound of the unknown `blocked` leaves it on the same side.
void BalanceSearch::explain(int blocked) {
  // Junctions that move by more than this fraction of the motion of `blocked` are joined with it.
  constexpr double together = 0.5;
  double left = 0;
  for (Eigen::Index i = 0; i < d_.size(); ++i)
    if (std::abs(d_[i]) > together * std::abs(d_[blocked])) left -= f_[i];
  const Balance& balance = balances_[static_cast<std::size_t>(blocked)];
  const int unknown = system_.dofs() + balance.unknown;
  why_ = fmt::format("{:.3g} {} are left for {}: {}", std::abs(left), system_.equation_units(unknown),
                     system_.unknown_name(unknown),
                     d_[blocked] > 0 ? balance.range.when_beyond : balance.range.when_below);
}

bool BalanceSearch::find(const Environment& environment, State& state) {
  constexpr int most = 100;
  why_.clear();
  const VectorX before = state.first_order;
  for (const Balance& each : balances_) {
    double& y = state.first_order[each.unknown];
    y = std::isfinite(y) ? std::clamp(y, each.range.least, each.range.most) : 0.0;
  }
  try {
    for (int iteration = 0; iteration < most; ++iteration) {
      for (std::size_t k = 0; k < balances_.size(); ++k)
        y_[static_cast<Eigen::Index>(k)] = state.first_order[balances_[k].unknown];
      evaluate(state, environment, true);
      if (balanced()) return true;
      if (!set_direction()) break;
      if (go(state, environment) != Way::found) break;
    }
  } catch (const ComputationError&) {
    // a component cannot be evaluated at the present values
  }
  state.first_order = before;
  return false;
}

}  // namespace bielle::mechanism
