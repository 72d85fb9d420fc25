#include "mechanism/solvers/start/one_sided_holds.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Flags = std::vector<char>;

/// Searches sets of active constraints in the order of their number of exchanges.
class Exchange {
 public:
  Exchange(const System& system, const Environment& environment, const State& begun, KktMatrix& saddle)
      : system_(system), environment_(environment), begun_(begun), saddle_(saddle) {
    const std::vector<MemberEventFunction>& events = system.event_functions();
    for (int k = 0; k < static_cast<int>(events.size()); ++k) {
      const auto [member, index, function, name] = events[static_cast<std::size_t>(k)];
      if (function.one_sided == EventFunction::OneSided::no) continue;
      const int multiplier = system.slots()[member].multiplier_begin;
      if (holds_.empty() || holds_.back().multiplier != multiplier) holds_.push_back({multiplier, -1, -1});
      (function.one_sided == EventFunction::OneSided::opens ? holds_.back().opens : holds_.back().violated) = k;
    }
  }

  /// Returns whether a one-sided constraint is set aside.
  bool any_aside() const {
    return std::any_of(holds_.begin(), holds_.end(),
                       [&](const Hold& hold) { return flag(begun_.idle, hold) == Idle::redundant; });
  }

  /// The constraints of a state whose motion or force has the wrong sign.
  struct Wrong {
    std::vector<std::size_t> violated, pulling;  ///< numbers among the one-sided constraints
    bool none() const { return violated.empty() && pulling.empty(); }
  };
  Wrong find_wrong(const State& state) const {
    Wrong wrong;
    for (std::size_t k = 0; k < holds_.size(); ++k) {
      const Hold& hold = holds_[k];
      const char idle = flag(state.idle, hold);
      const int event = idle == Idle::redundant ? hold.violated : hold.opens;
      if (idle == Idle::switched_off || !(system_.calc_event_function(state, environment_, event) > 0)) continue;
      (idle == Idle::redundant ? wrong.violated : wrong.pulling).push_back(k);
    }
    return wrong;
  }

  /// @returns a set in which nothing is wrong. If there is none and a constraint is violated at first, it is a set
  /// without violated constraints.
  std::optional<Flags> find(const Wrong& at_first) {
    constexpr std::size_t most = 200;  // trials
    std::optional<Flags> fair;
    try_exchanges(begun_.idle, at_first);
    for (std::size_t k = 0; !waiting_.empty() && k < most; ++k) {
      const Flags flags = waiting_.front();
      waiting_.pop_front();
      State trial = begun_;
      trial.idle = flags;
      if (!make_consistent(trial)) continue;
      const Wrong wrong = find_wrong(trial);
      if (wrong.none()) return flags;
      if (wrong.violated.empty() && !fair) fair = flags;
      try_exchanges(flags, wrong);
    }
    if (at_first.violated.empty()) return {};
    if (fair) return fair;
    const int equation = system_.size() - system_.multipliers() + holds_[at_first.violated.front()].multiplier;
    throw ComputationError(fmt::format(
        "t = {:.6g} s: {} cannot hold: a drive, a lock or another one-way clutch moves it against its free direction",
        begun_.time, system_.equation_name(equation)));
  }

 private:
  struct Hold {
    int multiplier, opens, violated;  ///< its number, and those of its event functions
  };
  static char flag(const Flags& flags, const Hold& hold) {
    return flags.empty() ? char{Idle::active} : flags[static_cast<std::size_t>(hold.multiplier)];
  }

  /// Adds sets to the queue in which a violated constraint replaces an active one, or one that is set aside replaces
  /// one that pulls.
  void try_exchanges(const Flags& flags, const Wrong& wrong) {
    const auto exchange = [&](std::size_t takes, std::size_t yields) {
      if (flag(flags, holds_[takes]) != Idle::redundant || flag(flags, holds_[yields]) != Idle::active) return;
      Flags next = flags;
      next[static_cast<std::size_t>(holds_[takes].multiplier)] = Idle::active;
      next[static_cast<std::size_t>(holds_[yields].multiplier)] = Idle::redundant;
      if (known_.insert(next).second) waiting_.push_back(std::move(next));
    };
    for (std::size_t k = 0; k < holds_.size(); ++k) {
      for (const std::size_t violated : wrong.violated) exchange(violated, k);
      for (const std::size_t pulling : wrong.pulling) exchange(k, pulling);
    }
  }

  /// @returns whether its active constraints are independent and have consistent velocities and accelerations
  bool make_consistent(State& trial) {
    std::vector<int> aside;
    system_.for_each_redundant(trial, [&](int k) { aside.push_back(k); });
    for (const int k : find_redundant(system_, environment_, trial))
      if (!std::binary_search(aside.begin(), aside.end(), k)) return false;
    trial.reaction.resize(0);  // removes the reactions of another set
    StartReport unused;
    saddle_.serve_no_more();
    try {
      make_velocities_consistent(system_, environment_, trial, unused, saddle_);
      make_accelerations_consistent(system_, environment_, trial, saddle_);
    } catch (const ComputationError&) {
      return false;
    }
    return true;
  }

  const System& system_;
  const Environment& environment_;
  const State& begun_;
  KktMatrix& saddle_;
  std::vector<Hold> holds_;
  std::set<Flags> known_;
  std::deque<Flags> waiting_;
};

}  // namespace

bool exchange_one_sided(const System& system, const Environment& environment, const State& begun, State& made,
                        StartReport& report, KktMatrix& saddle) {
  Exchange exchange(system, environment, begun, saddle);
  if (!exchange.any_aside()) return false;
  State found = made;
  found.reaction.resize(0);
  const Exchange::Wrong wrong = exchange.find_wrong(found);
  if (wrong.none()) return false;
  std::optional<Flags> flags = exchange.find(wrong);
  saddle.serve_no_more();
  if (!flags) return false;
  made = begun;
  made.idle = *std::move(flags);
  make_velocities_consistent(system, environment, made, report, saddle);
  make_accelerations_consistent(system, environment, made, saddle);
  return true;
}

}  // namespace bielle::mechanism
