#include "mechanism/solvers/linearised/turning_part.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/model/start_coordinates.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/joint_twist.hpp"
#include "mechanism/solvers/start/part_behind.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr double no_screw = 1e-9;  // largest pitch of the joint's motion, relative to the mechanism's size

/// Returns the coordinates of a joint that are angles.
std::vector<std::size_t> angles_of(const Member& joint) {
  std::vector<std::size_t> angles;
  const std::vector<StartCoordinate> coordinates = start_coordinates_of(*joint.component);
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    if (coordinates[k].units == "rad") angles.push_back(k);
  return angles;
}

}  // namespace

std::string no_turning_joint(const Member& joint) {
  const std::size_t angles = angles_of(joint).size();
  if (angles == 1) return {};
  return fmt::format("{} {}: a steady rotation needs a joint with one angle (a hinge)", describe(joint),
                     angles == 0 ? "has no angle" : "turns about several axes");
}

TurningPart::TurningPart(const System& system, const Environment& environment, const State& state, std::size_t joint)
    : joint_(joint), turns_(state.nodes.size(), 0), drives_(static_cast<std::size_t>(system.multipliers()), 0) {
  for (const Slots& slots : system.slots())
    if (slots.nodes.empty() && slots.references.size() == 1 && slots.references[0] == &system.slots()[joint])
      for (int k = 0; k < slots.multipliers; ++k) drives_[static_cast<std::size_t>(slots.multiplier_begin + k)] = 1;
  const Member& member = system.model().members()[joint];
  if (const std::string reason = no_turning_joint(member); !reason.empty()) throw ComputationError(reason);
  const std::size_t angle = angles_of(member).front();
  const std::vector<int>& nodes = system.slots()[joint].nodes;
  if (nodes.size() != 2) throw ComputationError(fmt::format("{} does not join two nodes", describe(member)));
  JointTwist twist(system, environment, state);
  std::string way_back;
  for (const auto& [moving, base] : {std::pair(nodes[1], nodes[0]), std::pair(nodes[0], nodes[1])}) {
    if (all_held(system.model().node(moving))) continue;
    const RigidVelocity motion = twist.of_unit_rate(joint, moving, base, angle);
    const PartBehind part =
        part_behind(system, joint, moving, base, [&](std::size_t m) { return twist.allows(m, motion); });
    if (part.nodes.empty()) {
      if (way_back.empty()) way_back = part.way_back;
      continue;
    }
    const double rate = motion.omega.norm();
    const double length = model_length(state);
    if (!(rate > 0) || std::abs(motion.v.dot(motion.omega)) > no_screw * rate * rate * length)
      throw ComputationError(fmt::format("{} moves along its axis as it turns: no steady rotation", describe(member)));
    moving_ = moving;
    base_ = base;
    for (const int node : part.nodes) turns_[static_cast<std::size_t>(node)] = 1;
    const NodeState& from = state.nodes[static_cast<std::size_t>(base)];
    const Vector3 on_axis = motion.place + motion.omega.cross(motion.v) / (rate * rate);
    axis_ = from.R.transpose() * (motion.omega / rate);
    point_ = from.R.transpose() * (on_axis - from.x);
    return;
  }
  throw ComputationError(fmt::format(
      "nothing turns behind {} alone: both of its sides are connected to what is held, or to each other, by "
      "{}",
      describe(member), way_back.empty() ? std::string("a rigid body") : way_back));
}

Vector3 TurningPart::axis(const State& state) const { return state.nodes[static_cast<std::size_t>(base_)].R * axis_; }

Vector3 TurningPart::through(const State& state) const {
  const NodeState& base = state.nodes[static_cast<std::size_t>(base_)];
  return base.x + base.R * point_;
}

void TurningPart::set_motion(double rate, std::vector<NodeState>& nodes, const State& state) const {
  const Vector3 omega = rate * axis(state), c = through(state);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    NodeState& node = nodes[k];
    const bool turning = turns_[k] != 0;
    node.v = turning ? Vector3(omega.cross(node.x - c)) : Vector3::Zero();
    node.a = turning ? Vector3(omega.cross(node.v)) : Vector3::Zero();
    node.Omega = turning ? Vector3(node.R.transpose() * omega) : Vector3::Zero();
    node.Omegadot.setZero();
  }
}

void TurningPart::turn_by(double angle, State& state) const {
  const Vector3 c = through(state);
  const Matrix3 turned = exp_so3(Vector3(angle * axis(state)));
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    if (turns_[k] == 0) continue;
    NodeState& node = state.nodes[k];
    node.x = c + turned * (node.x - c);
    node.R = turned * node.R;
    node.v = turned * node.v;
    node.a = turned * node.a;
  }
}

std::vector<char> TurningPart::turning_unknowns(const System& system) const {
  std::vector<char> turning(static_cast<std::size_t>(system.dofs() + system.first_orders()), 0);
  const int of_nodes = system.kinematics().unknowns();
  for (int i = 0; i < of_nodes; ++i)
    turning[static_cast<std::size_t>(i)] = turns_[static_cast<std::size_t>(system.kinematics().node_of(i))];
  for (const Slots& slots : system.slots()) {
    bool all = !slots.nodes.empty();
    for (const int node : slots.nodes) all = all && turns(node);
    if (!all) continue;
    for (int k = 0; k < slots.amplitudes; ++k)
      turning[static_cast<std::size_t>(of_nodes + slots.amplitude_begin + k)] = 1;
    for (int k = 0; k < slots.first_orders; ++k)
      turning[static_cast<std::size_t>(system.dofs() + slots.first_order_begin + k)] = 1;
  }
  return turning;
}

}  // namespace bielle::mechanism
