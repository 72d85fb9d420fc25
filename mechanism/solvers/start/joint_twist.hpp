// The motion of one side of a joint relative to the other that the rates of its coordinates require.
#pragma once

#include <vector>

#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {

/// Motion of a rigid body: the velocity [m/s] of its point at a place, and its angular velocity [rad/s]; inertial.
struct RigidVelocity {
  Vector3 place = Vector3::Zero(), v = Vector3::Zero(), omega = Vector3::Zero();
  Vector3 at(const Vector3& x) const { return v + omega.cross(x - place); }
};

RigidVelocity rigid_velocity(const NodeState& node);
void set_rigid_velocity(NodeState& node, const RigidVelocity& motion);

/// Evaluates members while nodes move in turn; the state is a copy, whose nodes are restored afterwards.
class JointTwist {
 public:
  JointTwist(const System& system, const Environment& environment, const State& state);

  /// Returns the motion of the moving side of a joint, including its relative motion.
  /// @param joint   member with two nodes @param moving,base  its nodes @param conditions  start rates
  /// @throws ComputationError if a start rate contradicts the joint, its drives or its locks
  RigidVelocity of(std::size_t joint, int moving, int base, const StartConditions& conditions);
  /// Returns the motion of the moving side relative to the other one that the joint's constraints permit if one
  /// coordinate has the rate 1 and its other coordinates stand still; drives and locks are ignored.
  RigidVelocity of_unit_rate(std::size_t joint, int moving, int base, std::size_t coordinate);
  /// Returns whether the constraints of a member of two nodes permit this motion of one node while the other does not
  /// change.
  bool allows(std::size_t member, const RigidVelocity& motion);
  /// Sets other velocities of nodes.
  void set_rates(const State& state);

 private:
  /// Returns the rates of a member's active constraints, with a node in motion.
  VectorX constraint_rates(std::size_t member, int node, const RigidVelocity& motion);
  VectorX all_rates(std::size_t joint, const std::vector<std::size_t>& drives, int moving, const RigidVelocity& motion);
  void append_constraints(std::size_t member, VectorX& rates) const;
  std::vector<std::size_t> acting_in(std::size_t joint) const;

  const System& system_;
  const Environment& environment_;
  State state_;
  double length_;
};

}  // namespace bielle::mechanism
