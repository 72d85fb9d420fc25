// The unknowns of a mechanism and their equations: numbers, kinds, names, units, sizes, start values.
//
// The order is: independent increments of the nodes, amplitudes, first-order unknowns, multipliers; each in the order
// of the members. The first two are called "dofs": they have inertia. A query about one unknown takes a time that does
// not grow with the model.
#pragma once

#include <array>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "mechanism/model/activity.hpp"
#include "mechanism/system/kind.hpp"
#include "mechanism/system/node_kinematics.hpp"

namespace bielle::mechanism {

/// Name of a member in messages: "joint 'main'", "element 'rod'".
std::string describe(const Member& member);

class Unknowns {
 public:
  /// The object keeps references to both.
  Unknowns(const Model& model, const NodeKinematics& kinematics);
  Unknowns(const Unknowns&) = delete;
  Unknowns& operator=(const Unknowns&) = delete;

  /// Numbers the unknowns that the next member of the model declares.
  void add(const Declaration& declaration);
  /// Call it when all members are added: it looks up their references.
  /// @throws InputError if components refer to each other in a circle
  void complete();
  /// Sets Slots::carried_axes of the members with the given constraints: their rows must hold along axes that are
  /// attached to their nodes.
  void carry_axes(const std::vector<bool>& of_multiplier);

  const std::vector<Slots>& slots() const { return slots_; }  ///< slots of the model's members, in their order
  /// Index of the member whose component is given; the component must belong to the model.
  std::size_t member_of(const Component& component) const { return member_index_.at(&component); }

  /// Returns whether a member is in the equations at a state; otherwise it has been released, and nobody evaluates it.
  bool is_active(const State& state, std::size_t member) const { return activities_.is_active(state, slots_, member); }
  const Activities& activities() const { return activities_; }

  int dofs() const { return nodes_ + amplitudes_; }
  int amplitudes() const { return amplitudes_; }
  int first_orders() const { return first_orders_; }
  int multipliers() const { return multipliers_; }
  int size() const { return first_multiplier() + multipliers_; }
  int first_amplitude() const { return nodes_; }
  int first_first_order() const { return dofs(); }
  int first_multiplier() const { return dofs() + first_orders_; }
  /// Number of rows of the largest local vector of any member.
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

  /// Sets the start values of all scalars and of the components' memory; rates are zero.
  void start(State& state) const;

 private:
  /// An unknown that does not belong to a node. Its texts are stored in words_, because only few are different.
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
  Activities activities_;
  std::vector<Slots> slots_;
  std::unordered_map<const Component*, std::size_t> member_index_;
  int nodes_, amplitudes_ = 0, first_orders_ = 0, multipliers_ = 0, largest_local_ = 0;  ///< nodes_: unknowns of nodes
  std::vector<Kind> kinds_;
  std::unordered_set<std::string> words_;
  std::vector<Scalar> scalars_;  ///< in the order of the unknowns
  std::vector<int> algebraic_, holdable_;
  std::vector<double> start_memory_;
  /// Used while members are added: scalars by kind; for each reference, the member that refers and the component
  /// referred to.
  std::array<std::vector<Scalar>, 3> added_;
  std::vector<std::pair<std::size_t, const Component*>> references_;
};

}  // namespace bielle::mechanism
