#include "mechanism/solvers/start/joint_twist.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "mechanism/math/rank.hpp"
#include "mechanism/model/start_coordinates.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {
namespace {

constexpr double twist_agreement = 1e-8;  // relative to the terms of the rates

/// Returns the k-th vector of a basis of the motions of a body about a place: translations in units of a length, and
/// rotations.
RigidVelocity unit_motion(int k, const Vector3& place, double length) {
  RigidVelocity motion{place, Vector3::Zero(), Vector3::Zero()};
  (k < 3 ? motion.v : motion.omega) = (k < 3 ? length : 1.0) * Vector3::Unit(k % 3);
  return motion;
}

RigidVelocity sum_of_motions(const RigidVelocity& a, const RigidVelocity& b) {
  return {a.place, a.v + b.at(a.place), a.omega + b.omega};
}

}  // namespace

RigidVelocity rigid_velocity(const NodeState& node) { return {node.x, node.v, node.R * node.Omega}; }

void set_rigid_velocity(NodeState& node, const RigidVelocity& motion) {
  node.v = motion.at(node.x);
  node.Omega = node.R.transpose() * motion.omega;
}

JointTwist::JointTwist(const System& system, const Environment& environment, const State& state)
    : system_(system), environment_(environment), state_(state), length_(model_extent(state)) {}

void JointTwist::set_rates(const State& state) { state_.nodes = state.nodes; }

void JointTwist::append_constraints(std::size_t member, VectorX& rates) const {
  const Slots& slots = system_.slots()[member];
  VectorX velocity = VectorX::Zero(slots.multipliers), unused = velocity;
  if (slots.multipliers > 0)
    system_.model().members()[member].component->add_constraint_rates(LocalState(state_, slots, environment_), velocity,
                                                                      unused);
  const Eigen::Index begin = rates.size();
  rates.conservativeResize(begin + slots.multipliers);
  for (int k = 0; k < slots.multipliers; ++k) {
    const auto at = static_cast<std::size_t>(slots.multiplier_begin + k);
    const bool off = !state_.idle.empty() && state_.idle[at] == Idle::switched_off;
    rates[begin + k] = off ? 0 : velocity[k];
  }
}

VectorX JointTwist::constraint_rates(std::size_t member, int node, const RigidVelocity& motion) {
  NodeState& moved = state_.nodes[static_cast<std::size_t>(node)];
  const NodeState before = moved;
  set_rigid_velocity(moved, motion);
  VectorX rates(0);
  append_constraints(member, rates);
  moved = before;
  return rates;
}

bool JointTwist::allows(std::size_t member, const RigidVelocity& motion) {
  const std::vector<int>& nodes = system_.slots()[member].nodes;
  if (nodes.size() != 2) return false;
  for (const int node : nodes) {
    if (node == 0) continue;
    const NodeState& own = state_.nodes[static_cast<std::size_t>(node)];
    const RigidVelocity at_rest{own.x, Vector3::Zero(), Vector3::Zero()};
    const VectorX rates = constraint_rates(member, node, motion), rest = constraint_rates(member, node, at_rest);
    // `size` is the largest contribution to each row that a motion of this speed can have. At the node itself the
    // motion may be zero, up to rounding.
    const double speed = (motion.v.norm() + motion.omega.norm() * length_) / length_;
    VectorX size = rest.cwiseAbs();
    for (int k = 0; k < 6; ++k) {
      const RigidVelocity unit = unit_motion(k, own.x, length_);
      size += speed * (constraint_rates(member, node, unit) - rest).cwiseAbs();
    }
    if ((rates.array().abs() <= twist_agreement * size.array()).all()) return true;
  }
  return false;
}

/// Returns drives and locks of the joint's coordinates: members that refer only to it and have constraints.
std::vector<std::size_t> JointTwist::acting_in(std::size_t joint) const {
  std::vector<std::size_t> members;
  const Slots& own = system_.slots()[joint];
  for (std::size_t m = 0; m < system_.slots().size(); ++m) {
    const Slots& slots = system_.slots()[m];
    if (slots.multipliers > 0 && slots.nodes.empty() && slots.references.size() == 1 && slots.references[0] == &own)
      members.push_back(m);
  }
  return members;
}

namespace {

/// Rows A x = b; earlier rows have priority in their rank.
struct TwistRates {
  MatrixX A;  ///< (rows, 6)
  VectorX b;
};

/// Returns the smallest x that satisfies the independent rows.
Vector6 least_solution(const TwistRates& rates) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row < rates.A.rows(); ++row) {
    const double size = rates.A.row(row).norm();
    for (int i = 0; i < 6; ++i)
      if (rates.A(row, i) != 0) entries.emplace_back(i, static_cast<int>(row), rates.A(row, i) / size);
  }
  Eigen::SparseMatrix<double> columns(6, rates.A.rows());
  columns.setFromTriplets(entries.begin(), entries.end());
  const std::vector<int> dependent = dependent_columns(columns, 1e-9);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < rates.A.rows(); ++row)
    if (!std::binary_search(dependent.begin(), dependent.end(), static_cast<int>(row)) && !rates.A.row(row).isZero(0))
      rows.push_back(row);
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count == 0) return Vector6::Zero();
  MatrixX independent(count, 6);
  VectorX wanted(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index row = rows[static_cast<std::size_t>(k)];
    const double size = rates.A.row(row).norm();
    independent.row(k) = rates.A.row(row) / size;
    wanted[k] = rates.b[row] / size;
  }
  return independent.transpose() * solve_symmetric(MatrixX(independent * independent.transpose()), wanted);
}

}  // namespace

/// Computes the rates of constraints, of drives, and of coordinates, for a given motion of the moving node.
VectorX JointTwist::all_rates(std::size_t joint, const std::vector<std::size_t>& drives, int moving,
                              const RigidVelocity& motion) {
  NodeState& node = state_.nodes[static_cast<std::size_t>(moving)];
  const NodeState before = node;
  set_rigid_velocity(node, motion);
  VectorX rates(0);
  append_constraints(joint, rates);
  for (const std::size_t drive : drives) append_constraints(drive, rates);
  const Eigen::Index constraints = rates.size();
  const std::size_t count = start_coordinates_of(*system_.model().members()[joint].component).size();
  rates.conservativeResize(constraints + static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k)
    rates[constraints + static_cast<Eigen::Index>(k)] = coordinate_row(system_, environment_, state_, joint, k).rate;
  node = before;
  return rates;
}

RigidVelocity JointTwist::of(std::size_t joint, int moving, int base, const StartConditions& conditions) {
  const Vector3 place = state_.nodes[static_cast<std::size_t>(moving)].x;
  RigidVelocity carried = rigid_velocity(state_.nodes[static_cast<std::size_t>(base)]);
  carried = {place, carried.at(place), carried.omega};
  const std::vector<std::size_t> drives = acting_in(joint);
  const std::vector<StartCoordinate> coordinates = start_coordinates_of(*system_.model().members()[joint].component);
  const VectorX rest = all_rates(joint, drives, moving, carried);
  TwistRates all{MatrixX(rest.size(), 6), -rest};
  for (int k = 0; k < 6; ++k)
    all.A.col(k) = all_rates(joint, drives, moving, sum_of_motions(carried, unit_motion(k, place, length_))) - rest;
  // Given start rates have priority over coordinates without one.
  const Eigen::Index first = rest.size() - static_cast<Eigen::Index>(coordinates.size());
  std::vector<const CoordinateCondition*> given;
  for (const CoordinateCondition& each : conditions.coordinates)
    if (each.member == joint && each.rate) given.push_back(&each);
  std::vector<Eigen::Index> order;
  for (Eigen::Index row = 0; row < first; ++row) order.push_back(row);
  for (const CoordinateCondition* each : given) {
    order.push_back(first + static_cast<Eigen::Index>(each->coordinate));
    all.b[order.back()] += *each->rate;
  }
  for (Eigen::Index row = first; row < rest.size(); ++row)
    if (std::find(order.begin(), order.end(), row) == order.end()) order.push_back(row);
  TwistRates ordered{MatrixX(rest.size(), 6), VectorX(rest.size())};
  for (std::size_t k = 0; k < order.size(); ++k) {
    ordered.A.row(static_cast<Eigen::Index>(k)) = all.A.row(order[k]);
    ordered.b[static_cast<Eigen::Index>(k)] = all.b[order[k]];
  }
  const Vector6 twist = least_solution(ordered);
  for (const CoordinateCondition* each : given) {
    const Eigen::Index row = first + static_cast<Eigen::Index>(each->coordinate);
    const double lack = all.b[row] - all.A.row(row).dot(twist);
    if (std::abs(lack) <=
        twist_agreement * (std::abs(all.b[row]) + all.A.row(row).cwiseAbs().dot(twist.cwiseAbs().transpose())))
      continue;
    const StartCoordinate& coordinate = coordinates[each->coordinate];
    throw ComputationError(
        fmt::format("the start rate {:.6g} {} of {} contradicts the joint itself, or its drives, locks and other start "
                    "rates, which "
                    "make it {:.6g} {}: leave one of them out, or make them agree",
                    *each->rate, coordinate.rate_units, coordinate_name(system_, joint, coordinate), *each->rate - lack,
                    coordinate.rate_units));
  }
  return sum_of_motions(carried, {place, length_ * twist.head<3>(), twist.tail<3>()});
}

RigidVelocity JointTwist::of_unit_rate(std::size_t joint, int moving, int base, std::size_t coordinate) {
  const NodeState base_before = state_.nodes[static_cast<std::size_t>(base)];
  const Vector3 place = state_.nodes[static_cast<std::size_t>(moving)].x;
  const RigidVelocity still{place, Vector3::Zero(), Vector3::Zero()};
  set_rigid_velocity(state_.nodes[static_cast<std::size_t>(base)], still);
  const VectorX rest = all_rates(joint, {}, moving, still);
  const std::size_t count = start_coordinates_of(*system_.model().members()[joint].component).size();
  TwistRates all{MatrixX(rest.size(), 6), -rest};
  for (int k = 0; k < 6; ++k) all.A.col(k) = all_rates(joint, {}, moving, unit_motion(k, place, length_)) - rest;
  all.b[rest.size() - static_cast<Eigen::Index>(count - coordinate)] += 1;
  state_.nodes[static_cast<std::size_t>(base)] = base_before;
  const Vector6 twist = least_solution(all);
  return {place, length_ * twist.head<3>(), twist.tail<3>()};
}

}  // namespace bielle::mechanism
