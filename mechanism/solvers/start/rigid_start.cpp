#include "mechanism/solvers/start/rigid_start.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "mechanism/solvers/start/joint_twist.hpp"
#include "mechanism/solvers/start/part_behind.hpp"
#include "mechanism/solvers/start/start_rates.hpp"

namespace bielle::mechanism {
namespace {

/// A joint with its carried part and the part's motion.
struct Carrying {
  std::size_t joint = 0;
  int moving = 0, base = 0;
  std::vector<int> nodes;
  RigidVelocity motion;
};

class RigidStart {
 public:
  RigidStart(const System& system, const Environment& environment, const StartConditions& conditions, State& state)
      : system_(system),
        environment_(environment),
        conditions_(conditions),
        state_(state),
        twist_(system, environment, state) {
    for (const std::size_t joint : conditions.carrying) joints_.push_back(find(joint));
    // The outermost joint is first, because the part behind it contains the parts behind the others.
    std::stable_sort(joints_.begin(), joints_.end(),
                     [](const Carrying& a, const Carrying& b) { return a.nodes.size() > b.nodes.size(); });
  }

  /// Sets the velocities of the carried parts from those of the other sides.
  void set() {
    for (Carrying& each : joints_) {
      twist_.set_rates(state_);
      each.motion = twist_.of(each.joint, each.moving, each.base, conditions_);
      for (const int node : each.nodes) set_rigid_velocity(state_.nodes[static_cast<std::size_t>(node)], each.motion);
    }
    const std::vector<NodeState> wanted = state_.nodes;
    VectorX v(system_.dofs()), a(system_.dofs());
    system_.get_rates(state_, v, a);
    system_.set_rates(state_, v, a);
    for (const Carrying& each : joints_)
      for (const int node : each.nodes) check_held(each, node, wanted[static_cast<std::size_t>(node)]);
    check_constraints(v);
  }

  /// Checks that velocities given in the file for carried nodes equal those that they get.
  void check_given() const {
    for (const Carrying& each : joints_)
      for (const int node : each.nodes) check_given(each, node);
  }

  VectorX velocities_of_carried() const {
    VectorX v(6 * static_cast<Eigen::Index>(all_.size()));
    Eigen::Index at = 0;
    for (const int node : all_) {
      const NodeState& own = state_.nodes[static_cast<std::size_t>(node)];
      v.segment<6>(at) << own.v, length() * own.Omega;
      at += 6;
    }
    return v;
  }

  void report(StartReport& report) const {
    for (const Carrying& each : joints_) {
      CarriedPart part;
      part.joint = describe(each.joint);
      for (const int node : each.nodes)
        if (const Node& own = system_.model().node(node); own.internal)
          ++part.inner;
        else
          part.nodes.push_back(own.name);
      report.carried.push_back(std::move(part));
    }
  }

 private:
  std::string describe(std::size_t member) const { return mechanism::describe(system_.model().members()[member]); }
  double length() const { return model_length(state_); }

  Carrying find(std::size_t joint) {
    const std::vector<int>& nodes = system_.slots()[joint].nodes;
    std::vector<std::pair<int, int>> sides;  // moving side, base; the second node is the moving side if it can move
    for (const auto& [moving, base] : {std::pair(nodes[1], nodes[0]), std::pair(nodes[0], nodes[1])})
      if (!all_held(system_.model().node(moving))) sides.emplace_back(moving, base);
    std::string way_back;
    for (const auto& [moving, base] : sides) {
      const RigidVelocity motion = twist_.of(joint, moving, base, conditions_);
      PartBehind part =
          part_behind(system_, joint, moving, base, [&](std::size_t m) { return twist_.allows(m, motion); });
      if (!part.nodes.empty()) {
        all_.insert(part.nodes.begin(), part.nodes.end());
        return {joint, moving, base, std::move(part.nodes), motion};
      }
      if (way_back.empty()) way_back = part.way_back;
    }
    if (sides.empty())
      throw ComputationError(
          fmt::format("{} carries nothing at the start: both of its nodes are held", describe(joint)));
    throw ComputationError(fmt::format(
        "{} cannot carry what is behind it at the start: that is joined back to what is held, or to the other "
        "side, by {}. Leave `carries` out: velocities then change from those that are given by as little kinetic "
        "energy as the start rates and joints allow",
        describe(joint), way_back.empty() ? std::string("a rigid body") : way_back));
  }

  void check_held(const Carrying& by, int index, const NodeState& wanted) const {
    const NodeState& got = state_.nodes[static_cast<std::size_t>(index)];
    const double size = by.motion.v.norm() + by.motion.omega.norm() * length() + wanted.v.norm();
    const Node& node = system_.model().node(index);
    if ((got.v - wanted.v).norm() > rounding * size)
      throw ComputationError(fmt::format(
          "{} cannot carry node '{}' at the start: that is held in a direction in which it would move (by {:.3g} "
          "m/s)",
          describe(by.joint), node.name, (got.v - wanted.v).norm()));
    const double turns = (got.Omega - wanted.Omega).norm();
    if (turns * length() > rounding * size && feels_rotation(by, index))
      throw ComputationError(fmt::format(
          "{} cannot carry node '{}' at the start: that is held against turning, and would turn at {:.3g} rad/s",
          describe(by.joint), node.name, turns));
  }

  /// Returns whether any member depends on the rotation of a node. None does at an interface that only transmits
  /// forces.
  bool feels_rotation(const Carrying& by, int index) const {
    constexpr double turn = 0.1;  // [rad]
    State turned = state_;
    NodeState& node = turned.nodes[static_cast<std::size_t>(index)];
    node.R = node.R * exp_so3(Vector3(turn, turn, turn));
    node.Omega = node.Omega + node.R.transpose() * by.motion.omega;
    for (std::size_t m = 0; m < system_.slots().size(); ++m) {
      const Slots& slots = system_.slots()[m];
      if (std::find(slots.nodes.begin(), slots.nodes.end(), index) == slots.nodes.end()) continue;
      if (!system_.is_active(state_, m)) continue;
      const Component& component = *system_.model().members()[m].component;
      Declaration declaration;
      component.declare(declaration);
      if (declaration.passive) continue;
      VectorX before = VectorX::Zero(slots.size()), after = before;
      component.add_residual(LocalState(state_, slots, environment_), before);
      component.add_residual(LocalState(turned, slots, environment_), after);
      if ((after - before).norm() > rounding * (after.norm() + before.norm())) return true;
    }
    return false;
  }

  /// Checks that constraints of the carried parts permit the motion. @param v  (dofs)
  void check_constraints(const VectorX& v) const {
    if (system_.multipliers() == 0) return;
    VectorX rates(system_.multipliers()), unused(system_.multipliers());
    system_.constraint_rates(state_, environment_, rates, unused);
    // `sizes` is the largest contribution of these motions to each row. At a node the motion may be zero, up to
    // rounding.
    double speed = 0;
    for (const Carrying& each : joints_)
      speed = std::max(speed, each.motion.v.norm() + each.motion.omega.norm() * length());
    VectorX sizes = VectorX::Zero(system_.multipliers());
    std::vector<double> values;
    system_.tangent(state_, environment_, TangentWeights{0, 0, 0, 0, 1, true}, nullptr, values);
    const int first = system_.size() - system_.multipliers();
    const double length = this->length();
    system_.pattern().for_each([&](int place, int row, int column) {
      if (row >= system_.dofs() || column < first) return;
      const double most = system_.kind(row) == Kind::rotation ? speed / length : speed;
      sizes[column - first] += std::abs(values[static_cast<std::size_t>(place)]) * std::max(most, std::abs(v[row]));
    });
    std::vector<bool> off(static_cast<std::size_t>(system_.multipliers()), false);
    system_.for_each_idle(state_, [&](int k) { off[static_cast<std::size_t>(k)] = true; });
    for (std::size_t m = 0; m < system_.slots().size(); ++m)
      if (const Slots& slots = system_.slots()[m]; slots.multipliers > 0 && touches(slots))
        for (int k = slots.multiplier_begin; k < slots.multiplier_begin + slots.multipliers; ++k)
          if (!off[static_cast<std::size_t>(k)] && std::abs(rates[k]) > rounding * (sizes[k] + std::abs(rates[k])))
            throw_refused(m);
  }

  bool touches(const Slots& slots) const {
    for (const int node : slots.nodes)
      if (all_.contains(node)) return true;
    return std::any_of(slots.references.begin(), slots.references.end(),
                       [&](const Slots* other) { return touches(*other); });
  }

  [[noreturn]] void throw_refused(std::size_t member) const {
    std::vector<std::string> joints;
    for (const Carrying& each : joints_) joints.push_back(describe(each.joint));
    throw ComputationError(
        fmt::format("{} does not let move as one rigid body what {} {} at the start: leave `carries` out, or give the "
                    "joints between them "
                    "start rates that fit, with `carries: all`",
                    describe(member), fmt::join(joints, ", "), joints.size() == 1 ? "carries" : "carry"));
  }

  void check_given(const Carrying& by, int index) const {
    const Node& node = system_.model().node(index);
    if (node.internal || node.carrier) return;
    const NodeState& own = state_.nodes[static_cast<std::size_t>(index)];
    constexpr double typed = 1e-6;  // numbers in a file have limited accuracy
    const double speed = own.v.norm() + own.Omega.norm() * length();
    if (!node.velocity.isZero() && (node.velocity - own.v).norm() > typed * (speed + node.velocity.norm()))
      throw ComputationError(fmt::format(
          "node '{}' is given the velocity ({:.6g}, {:.6g}, {:.6g}) m/s, but {} carries it at the start with "
          "({:.6g}, {:.6g}, {:.6g}) m/s: leave one of them out, or make them agree",
          node.name, node.velocity.x(), node.velocity.y(), node.velocity.z(), describe(by.joint), own.v.x(), own.v.y(),
          own.v.z()));
    const Vector3& Omega = node.angular_velocity;
    if (!Omega.isZero() && (Omega - own.Omega).norm() > typed * (own.Omega.norm() + Omega.norm()))
      throw ComputationError(fmt::format(
          "node '{}' is given the angular velocity ({:.6g}, {:.6g}, {:.6g}) rad/s, but {} carries it at the start "
          "with ({:.6g}, {:.6g}, {:.6g}) rad/s: leave one of them out, or make them agree",
          node.name, Omega.x(), Omega.y(), Omega.z(), describe(by.joint), own.Omega.x(), own.Omega.y(), own.Omega.z()));
  }

  static constexpr double rounding = 1e-8;
  const System& system_;
  const Environment& environment_;
  const StartConditions& conditions_;
  State& state_;
  JointTwist twist_;
  std::vector<Carrying> joints_;
  std::set<int> all_;  ///< all carried nodes
};

}  // namespace

void begin_velocities(const System& system, const Environment& environment, State& state,
                      const StartConditions& conditions, StartReport& report) {
  KktMatrix saddle(system);
  if (conditions.carrying.empty()) {
    make_velocities_consistent(system, environment, state, report, saddle);
  } else {
    RigidStart rigid(system, environment, conditions, state);
    // If velocities of other parts change, those of the parts that they carry are set again.
    constexpr int most = 4;
    constexpr double same = 1e-10;
    for (int round = 0; round < most; ++round) {
      rigid.set();
      const VectorX before = rigid.velocities_of_carried();
      make_velocities_consistent(system, environment, state, report, saddle);
      if ((rigid.velocities_of_carried() - before).norm() <= same * before.norm()) break;
    }
    rigid.check_given();
    rigid.report(report);
  }
  set_start_rates(system, environment, state, conditions, saddle, report);
}

}  // namespace bielle::mechanism
