// The unknowns of a mechanism and their equations: numbers, kinds, names, units, sizes, start values.
//
// Order: independent increments of the nodes, amplitudes, first-order unknowns, multipliers; each in the order of the
// members. "dofs" are the first two: what has inertia. Whatever is asked of one unknown takes a time that does not grow
// with the model.
#pragma once

#include <array>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "mechanism/system/kind.hpp"
#include "mechanism/system/node_kinematics.hpp"

namespace bielle::mechanism {

/// "joint 'main'", "element 'rod'": how a message names a member.
std::string describe(const Member& member);

class Unknowns {
 public:
  /// Keeps references to both.
  Unknowns(const Model& model, const NodeKinematics& kinematics);
  Unknowns(const Unknowns&) = delete;
  Unknowns& operator=(const Unknowns&) = delete;

  /// Numbers what the next member of the model declares.
  void add(const Declaration& declaration);
  /// To be called when all members are added: what they refer to is looked up.
  /// @throws InputError when components refer to each other in a circle
  void complete();
  /// Members whose constraint rows must hold along axes that ride on their nodes (Slots::carried_axes).
  void carry_axes(const std::vector<bool>& of_multiplier);

  const std::vector<Slots>& slots() const { return slots_; }  ///< of the model's members, in their order
  /// The member that a component is; the component must be of the model.
  std::size_t member_of(const Component& component) const { return member_index_.at(&component); }

  int dofs() const { return nodes_ + amplitudes_; }
  int amplitudes() const { return amplitudes_; }
  int first_orders() const { return first_orders_; }
  int multipliers() const { return multipliers_; }
  int size() const { return first_multiplier() + multipliers_; }
  int first_amplitude() const { return nodes_; }
  int first_first_order() const { return dofs(); }
  int first_multiplier() const { return dofs() + first_orders_; }
  /// Rows of the largest local vector of any member.
  int largest_local() const { return largest_local_; }

  Kind kind(int unknown) const { return kinds_[static_cast<std::size_t>(unknown)]; }
  ConstraintKind constraint_kind(int multiplier) const { return scalar(first_multiplier() + multiplier).constraint; }
  bool yields(int multiplier) const { return scalar(first_multiplier() + multiplier).yields; }
  double scale(int unknown) const { return unknown < nodes_ ? 0 : scalar(unknown).scale; }
  const std::vector<int>& algebraic() const { return algebraic_; }
  const std::vector<int>& holdable() const { return holdable_; }
  std::string name(int unknown) const;
  std::string equation_name(int equation) const;
  std::string equation_units(int equation) const;

  /// Start values of all scalars and of what components remember, rates zero.
  void start(State& state) const;

 private:
  /// An unknown that is none of a node. Words stand in words_: few differ.
  struct Scalar {
    double start, scale;
    const std::string *name, *equation_units;
    int member;
    ConstraintKind constraint;
    bool algebraic, holdable, yields;
  };
  const Scalar& scalar(int unknown) const { return scalars_[static_cast<std::size_t>(unknown - nodes_)]; }
  void append(Kind kind, const std::vector<Declaration::Scalar>& declared, std::vector<Scalar>& scalars);
  void resolve_references();
  void set_kinds();

  const Model& model_;
  const NodeKinematics& kinematics_;
  std::vector<Slots> slots_;
  std::unordered_map<const Component*, std::size_t> member_index_;
  int nodes_, amplitudes_ = 0, first_orders_ = 0, multipliers_ = 0, largest_local_ = 0;  ///< nodes_: unknowns of nodes
  std::vector<Kind> kinds_;
  std::unordered_set<std::string> words_;
  std::vector<Scalar> scalars_;  ///< in the order of the unknowns
  std::vector<int> algebraic_, holdable_;
  std::vector<double> start_memory_;
  /// While members are added: scalars by kind; of each reference, who refers to whom.
  std::array<std::vector<Scalar>, 3> added_;
  std::vector<std::pair<std::size_t, const Component*>> references_;
};

}  // namespace bielle::mechanism
