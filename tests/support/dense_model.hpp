// A model evaluated with dense matrices and without solvers, for the laws and the tests of elements.
//
// Unknowns in the order [6 per node of the model (dx inertial, dTheta node axes) | amplitudes | first-order |
// multipliers]; nothing is held, eliminated or scaled. It deliberately does not use system/'s assembly.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "mechanism/model/model.hpp"

namespace bielle::test {

using mechanism::Declaration;
using mechanism::Energy;
using mechanism::Environment;
using mechanism::MatrixX;
using mechanism::Model;
using mechanism::State;
using mechanism::VectorX;

class DenseModel {
 public:
  /// @param only          index of the only tested member; all of them otherwise. Components to which it refers are
  ///                      present but add nothing
  /// @param carried_axes  kind of axes of constraint rows, see Slots
  explicit DenseModel(const Model& model, std::optional<std::size_t> only = {}, bool carried_axes = true);

  int size() const { return multiplier_begin_ + multipliers_; }
  int nodes() const { return nodes_; }
  int amplitude_begin() const { return 6 * nodes_; }
  int first_order_begin() const { return amplitude_begin() + amplitudes_; }
  int multiplier_begin() const { return multiplier_begin_; }
  /// Returns the declarations of the tested members.
  const std::vector<Declaration>& declarations() const { return declarations_; }
  /// Returns whether a first-order unknown has no rate.
  bool is_algebraic(int first_order) const { return algebraic_[static_cast<std::size_t>(first_order)]; }
  mechanism::ConstraintKind constraint_kind(int multiplier) const {
    return constraint_kinds_[static_cast<std::size_t>(multiplier)];
  }

  Environment environment;

  /// Returns the nodes as in the model, scalars at their start values, no accelerations.
  State start() const;

  // Steps of a state along the unknowns: positions (nodes by the exponential map), rates, accelerations.
  void move(State& state, const VectorX& step) const;
  void move_rates(State& state, const VectorX& step) const;
  void move_accelerations(State& state, const VectorX& step) const;
  VectorX rates(const State& state) const;          ///< xdot, Omega, amplitude and first-order rates; multipliers 0
  VectorX accelerations(const State& state) const;  ///< likewise; first-order 0
  /// Returns the state a time s later on a path with the state's rates and accelerations, right up to s^2.
  State along_motion(const State& state, double s) const;

  VectorX residual(const State& state) const;
  /// One of the three tangents. @throws std::logic_error if a component wrote a part that was not requested, or outside
  /// of the pattern that it declares
  enum class Part { K, C, M };
  MatrixX tangent(const State& state, Part part) const;
  /// Returns the multipliers of the tested members (they come first), without those of components to which they refer.
  int own_multipliers() const { return own_multipliers_; }
  /// First and second time derivatives of the constraint rows.
  void constraint_rates(const State& state, VectorX& velocity, VectorX& acceleration) const;
  Energy energy(const State& state) const;

 private:
  void number(const mechanism::Component& component, const Declaration& declaration, mechanism::Slots& slots,
              bool carried_axes);
  void refer(std::size_t placed, const Declaration& declaration, bool carried_axes);
  void place(const mechanism::Slots& slots, std::vector<int>& place) const;
  struct Placed {
    const mechanism::Component* component;
    mechanism::Slots slots;
    std::vector<int> place;  ///< global unknown of each local one
  };
  std::vector<Placed> members_;  ///< looked at
  /// Slots of components to which they refer, and of further references; the addresses do not change.
  std::map<const mechanism::Component*, std::unique_ptr<mechanism::Slots>> slots_;
  std::vector<Declaration> all_declarations_;  ///< in the order of numbers
  std::vector<Declaration> declarations_;
  std::vector<mechanism::ConstraintKind> constraint_kinds_;
  std::vector<bool> algebraic_;  ///< for each first-order unknown
  const Model& model_;
  int nodes_ = 0, amplitudes_ = 0, first_orders_ = 0, multipliers_ = 0, memories_ = 0, multiplier_begin_ = 0,
      own_multipliers_ = 0;
};

/// Solves r = 0 at rest (rates and accelerations as in the state) by Newton's method in the `free` unknowns, full
/// steps.
/// @returns the number of iterations, or -1 if the largest residual did not fall below `tolerance` in `most` iterations
int solve_static(const DenseModel& model, State& state, const std::vector<int>& free, double tolerance, int most = 40);

}  // namespace bielle::test
