// Constraints that are out of the equations: set aside as redundant for a whole run, or switched off by their
// components.
//
// The equation of such a constraint says that its multiplier is zero; its row and column of the tangent are those of
// the identity.
#pragma once

#include <vector>

#include "mechanism/math/sparse_pattern.hpp"
#include "mechanism/system/unknowns.hpp"

namespace bielle::mechanism {

/// Why a constraint is out of the equations (State::idle).
enum Idle : char { active = 0, switched_off = 1, redundant = 2 };

class IdleConstraints {
 public:
  /// The object keeps references to both.
  IdleConstraints(const Model& model, const Unknowns& unknowns) : model_(model), unknowns_(unknowns) {}
  IdleConstraints(const IdleConstraints&) = delete;
  IdleConstraints& operator=(const IdleConstraints&) = delete;

  /// Adds the switchable constraints of the member that was numbered last: those that its component switches, or all if
  /// its entry can be released.
  void add(const Declaration& declaration);
  void set_aside(const std::vector<int>& multipliers) { set_aside_ = multipliers; }

  const std::vector<int>& set_aside() const { return set_aside_; }
  bool switches() const { return !switched_.empty(); }
  /// For each multiplier, whether it may be out of the equations at some state. Switching constraints may change which
  /// constraints are redundant: if one can be switched, all may be out.
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
  /// Sets `idle` of the switched constraints from the memory of their components and the activity of their entries; the
  /// others count as active.
  void switch_constraints(State& state, const Environment& environment) const;

  /// Finds the places of rows and columns of possibly idle constraints in the pattern of the tangent, which contains
  /// their diagonal.
  void find_places(const SparsePattern& pattern);
  /// Replaces rows and columns of the constraints that are out at a state by those of the identity.
  void clear(const State& state, std::vector<double>& values) const;

 private:
  const Model& model_;
  const Unknowns& unknowns_;
  std::vector<int> set_aside_;
  /// A constraint that can be switched.
  struct Switched {
    std::size_t member;
    int row, multiplier;  ///< local row of the component, and index among all multipliers
    bool by_itself;       ///< whether its component switches it; otherwise only the activity of its entry does
  };
  std::vector<Switched> switched_;
  /// Places of the row and the diagonal of each multiplier that may be idle; empty if there are none.
  std::vector<int> row_begin_, row_places_, diagonal_;
  std::vector<int> column_begin_;  ///< first place of the column of each multiplier, and one after the last
};

}  // namespace bielle::mechanism
