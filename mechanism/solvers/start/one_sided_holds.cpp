#include "mechanism/solvers/start/one_sided_holds.hpp"

#include <algorithm>
#include <deque>
#include <set>

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
    for (std::size_t k = 0; k < system.event_functions().size(); ++k)
      if (system.event_functions()[k].crossing.exchanges) events_.push_back(static_cast<int>(k));
  }

  /// Whether a one-sided constraint is set aside.
  bool any_aside() const {
    return std::any_of(events_.begin(), events_.end(), [&](int k) { return flag(begun_.idle, k) == Idle::redundant; });
  }

  /// Returns the event functions of the constraints that are violated at a state.
  std::vector<int> violated(const State& state) const {
    std::vector<int> found;
    for (const int k : events_)
      if (flag(state.idle, k) == Idle::redundant && system_.calc_crossing(state, environment_, k) > 0)
        found.push_back(k);
    return found;
  }

  Flags find(const std::vector<int>& violated_at_first) {
    constexpr std::size_t most = 200;  // trials
    try_exchanges(begun_.idle, violated_at_first);
    for (std::size_t k = 0; !waiting_.empty() && k < most; ++k) {
      const Flags flags = waiting_.front();
      waiting_.pop_front();
      State trial = begun_;
      trial.idle = flags;
      if (!make_consistent(trial)) continue;
      const std::vector<int> wrong = violated(trial);
      if (wrong.empty()) return flags;
      try_exchanges(flags, wrong);
    }
    const int equation = system_.size() - system_.multipliers() + multiplier(violated_at_first.front());
    throw ComputationError(fmt::format(
        "t = {:.6g} s: {} cannot hold: a drive, a lock or another one-way clutch moves it against its free direction",
        begun_.time, system_.equation_name(equation)));
  }

 private:
  int multiplier(int event) const {
    return system_.slots()[system_.event_functions()[static_cast<std::size_t>(event)].member].multiplier_begin;
  }
  char flag(const Flags& flags, int event) const {
    return flags.empty() ? char{Idle::active} : flags[static_cast<std::size_t>(multiplier(event))];
  }

  /// Lets sets wait in which a violated constraint takes the place of an active one.
  void try_exchanges(const Flags& flags, const std::vector<int>& wrong) {
    for (const int takes : wrong)
      for (const int yields : events_) {
        if (flag(flags, yields) != Idle::active) continue;
        Flags next = flags;
        next[static_cast<std::size_t>(multiplier(takes))] = Idle::active;
        next[static_cast<std::size_t>(multiplier(yields))] = Idle::redundant;
        if (known_.insert(next).second) waiting_.push_back(std::move(next));
      }
  }

  /// @returns whether its active constraints are independent and have consistent velocities and accelerations
  bool make_consistent(State& trial) {
    std::vector<int> aside;
    system_.for_each_redundant(trial, [&](int k) { aside.push_back(k); });
    if (find_redundant(system_, environment_, with_redundant(system_, trial)).size() != aside.size()) return false;
    for (const int k : find_redundant(system_, environment_, trial))
      if (!std::binary_search(aside.begin(), aside.end(), k)) return false;
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
  std::vector<int> events_;  ///< of one-sided constraints that are set aside and violated
  std::set<Flags> known_;
  std::deque<Flags> waiting_;
};

}  // namespace

std::optional<std::vector<char>> exchange_one_sided(const System& system, const Environment& environment,
                                                    const State& begun, const State& made, KktMatrix& saddle) {
  Exchange exchange(system, environment, begun, saddle);
  if (!exchange.any_aside()) return {};
  const std::vector<int> violated = exchange.violated(made);
  if (violated.empty()) return {};
  Flags flags = exchange.find(violated);
  saddle.serve_no_more();
  return flags;
}

}  // namespace bielle::mechanism
