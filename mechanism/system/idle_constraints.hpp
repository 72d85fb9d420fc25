// Constraints that are out of the equations: set aside as redundant for a whole run, or switched off by their
// components.
//
// The equation of such a constraint says that its multiplier is zero; its row and column of the tangent are those of
// the identity.
#pragma once

#include <vector>

#include "mechanism/math/sparse.hpp"
#include "mechanism/system/unknowns.hpp"

namespace bielle::mechanism {

/// Why a constraint is out of the equations (State::idle).
enum Idle : char { active = 0, switched_off = 1, redundant = 2 };

class IdleConstraints {
 public:
  /// Keeps references to both.
  IdleConstraints(const Model& model, const Unknowns& unknowns) : model_(model), unknowns_(unknowns) {}
  IdleConstraints(const IdleConstraints&) = delete;
  IdleConstraints& operator=(const IdleConstraints&) = delete;

  /// Notes which constraints the member that was numbered last can switch.
  void add(const Declaration& declaration);
  void set_aside(const std::vector<int>& multipliers) { set_aside_ = multipliers; }

  const std::vector<int>& set_aside() const { return set_aside_; }
  bool switches() const { return !switched_.empty(); }
  /// Which multipliers may be out of the equations at some state. Which constraints are redundant may change with those
  /// that are switched: where any can be, all may.
  std::vector<bool> possible() const;

  /// Calls act(multiplier) for each constraint that is out of the equations at a state, ascending.
  template <class Act>
  void for_each(const State& state, const Act& act) const {
    if (state.idle.empty()) {
      for (const int multiplier : set_aside_) act(multiplier);
      return;
    }
    for (int multiplier = 0; multiplier < static_cast<int>(state.idle.size()); ++multiplier)
      if (state.idle[static_cast<std::size_t>(multiplier)] != Idle::active) act(multiplier);
  }
  /// Sets `idle` of the switched constraints from what components remember; the others count as active.
  void switch_constraints(State& state, const Environment& environment) const;

  /// Notes where rows and columns of those that are possible stand in the pattern of the tangent, which holds their
  /// diagonal.
  void find_places(const SparsePattern& pattern);
  /// Rows and columns of those that are out at a state become the identity's.
  void clear(const State& state, std::vector<double>& values) const;

 private:
  const Model& model_;
  const Unknowns& unknowns_;
  std::vector<int> set_aside_;
  /// A constraint that can be switched.
  struct Switched {
    std::size_t member;
    int row, multiplier;  ///< of the component, and among all
  };
  std::vector<Switched> switched_;
  /// Places of the row and the diagonal of each multiplier that is possible; empty where none is.
  std::vector<int> row_begin_, row_places_, diagonal_;
  std::vector<int> column_begin_;  ///< of each multiplier, and one after the last: its column
};

}  // namespace bielle::mechanism
