// The part of a mechanism that turns steadily behind a joint, while the rest stands still.
//
// The axis is that of the joint, fixed in the node on its standing side: with R_0, x_0 of that node, the axis has the
// direction R_0 a and passes through x_0 + R_0 p. All nodes behind the joint (solvers/start/part_behind.hpp) have
//     v = w x (x - c),   a = w x v,   Omega = R^T w,   w = rate R_0 a,   c = x_0 + R_0 p.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the reason why no part turns steadily behind a joint of this kind; empty if it has one angle.
std::string no_turning_joint(const Member& joint);

class TurningPart {
 public:
  /// @param joint  member of the model with one coordinate that is an angle
  /// @throws ComputationError if the joint has no such coordinate, moves along its axis as well, or if both of its
  /// sides
  ///         are connected to what is held
  TurningPart(const System& system, const Environment& environment, const State& state, std::size_t joint);

  std::size_t joint() const { return joint_; }
  int base() const { return base_; }      ///< node on the standing side
  int moving() const { return moving_; }  ///< node on the turning side
  bool turns(int node) const { return turns_[static_cast<std::size_t>(node)] != 0; }
  /// Whether a constraint is that of a drive or a lock of the joint alone: in steady rotation it follows the given
  /// rate.
  bool drives_joint(int multiplier) const { return drives_[static_cast<std::size_t>(multiplier)] != 0; }
  Vector3 axis(const State& state) const;     ///< unit vector, inertial
  Vector3 through(const State& state) const;  ///< a point of the axis [m], inertial
  /// Sets the rates and accelerations of all nodes: those of the part turn, the others stand.
  void set_motion(double rate, std::vector<NodeState>& nodes, const State& state) const;
  /// Turns the part, with its rates and accelerations, about the axis. @param angle  [rad]
  void turn_by(double angle, State& state) const;
  /// For each dof and first-order unknown, whether it belongs to the part: those of its nodes, and those of members all
  /// of whose nodes are in the part.
  std::vector<char> turning_unknowns(const System& system) const;

 private:
  std::size_t joint_;
  int moving_ = -1, base_ = -1;
  std::vector<char> turns_, drives_;
  Vector3 axis_, point_;  ///< in the axes of the base
};

}  // namespace bielle::mechanism
