// Reactions of smallest norm where constraints are redundant, against dense algebra and closed forms.
#include <Eigen/QR>
#include <Eigen/SVD>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/joints/joint.hpp"
#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace test_reaction_norm {
namespace {

/// A model's text in units of other sizes, at another place, with its joints in another order and other second axes.
struct Variant {
  double length = 1, mass = 1;  ///< sizes of the new units' reciprocals: lengths are multiplied by it
  Vector3 shift = Vector3::Zero();
  bool reversed = false;
  Vector3 second_axis = Vector3::Zero();

  std::string place(double x, double y, double z) const {
    const Vector3 p = length * (Vector3(x, y, z) + shift);
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", p.x(), p.y(), p.z());
  }
  std::string node(const std::string& name, double x, double y, double z, const std::string& rest = "") const {
    return fmt::format("  {}: {{position: {}{}}}\n", name, place(x, y, z), rest);
  }
  std::string body(const std::string& name, double m, const Vector3& inertia) const {
    const Vector3 J = mass * length * length * inertia;
    return fmt::format(
        "  {0}: {{type: rigid_body, node: {0}, mass: {1:.17g}, inertia: [{2:.17g}, {3:.17g}, {4:.17g}]}}\n", name,
        mass * m, J.x(), J.y(), J.z());
  }
  std::string joint(const std::string& name, const std::string& type, const std::string& nodes, const std::string& axis,
                    double x, double y, double z) const {
    std::string text =
        fmt::format("  {}: {{type: {}, nodes: [{}], axis: {}, position: {}", name, type, nodes, axis, place(x, y, z));
    if (!second_axis.isZero(0))
      text += fmt::format(", second_axis: [{}, {}, {}]", second_axis.x(), second_axis.y(), second_axis.z());
    return text + "}\n";
  }
  std::string joints(std::vector<std::string> list) const {
    if (reversed) std::reverse(list.begin(), list.end());
    std::string text = "joints:\n";
    for (const std::string& each : list) text += each;
    return text;
  }
  std::string gravity(double x, double y, double z) const {
    return fmt::format("gravity: [{:.17g}, {:.17g}, {:.17g}]\n", length * x, length * y, length * z);
  }
};

/// Loads in all directions, so that nothing vanishes by symmetry.
std::string door(const Variant& as) {
  return as.gravity(1, 2, -9.81) + "nodes:\n" + as.node("door", 0.4, 0, 0.1, ", angular_velocity: [0, 0, 2]") +
         "elements:\n" + as.body("door", 20, {3, 4, 1}) +
         as.joints({as.joint("upper", "hinge", "ground, door", "[0, 0, 1]", 0, 0, 0.7),
                    as.joint("lower", "hinge", "ground, door", "[0, 0, 1]", 0, 0, -0.7)});
}

std::string four_bar(const Variant& as) {
  return as.gravity(0.3, -9.81, 2) + "nodes:\n" + as.node("crank", 0, 0.2, 0, ", angular_velocity: [0, 0, 5]") +
         as.node("coupler", 0.5, 0.7, 0) + as.node("rocker", 1, 0.5, 0) + "elements:\n" +
         as.body("crank", 1, {0.02, 0.001, 0.02}) + as.body("coupler", 1, {0.1, 0.1, 0.1}) +
         as.body("rocker", 1, {0.0833, 0.001, 0.0833}) +
         as.joints({as.joint("a", "hinge", "ground, crank", "[0, 0, 1]", 0, 0, 0),
                    as.joint("b", "hinge", "crank, coupler", "[0, 0, 1]", 0, 0.4, 0),
                    as.joint("c", "hinge", "coupler, rocker", "[0, 0, 1]", 1, 1, 0),
                    as.joint("d", "hinge", "ground, rocker", "[0, 0, 1]", 1, 0, 0)});
}

/// Returns a rigid bar on three supports: a ball and two planes.
std::string bar(const Variant& as) {
  return as.gravity(1, 2, -9.81) + "nodes:\n" + as.node("bar", 0.7, 0, 0) + "elements:\n" +
         as.body("bar", 3, {0.01, 0.5, 0.5}) +
         as.joints({as.joint("left", "spherical", "ground, bar", "[0, 0, 1]", 0, 0, 0),
                    as.joint("middle", "planar", "ground, bar", "[0, 0, 1]", 0.5, 0, 0),
                    as.joint("right", "cylindrical", "ground, bar", "[1, 0, 0]", 1.2, 0, 0)});
}

/// Bennett's loop: four hinges whose axes are skew can move if a/sin(alpha) = b/sin(beta) (G. T. Bennett, Engineering
/// 76 (1903) 777). Links a, b, a, b with twists alpha, beta; folded by theta at the first hinge.
std::string bennett(const Variant& as) {
  const double a = 1, alpha = 0.5, beta = 1.1, b = a * std::sin(beta) / std::sin(alpha), theta = 1.0;
  // tan(theta/2) tan(phi/2) = sin((beta + alpha)/2)/sin((beta - alpha)/2), from hinge to hinge.
  const double phi = 2 * std::atan(std::sin((beta + alpha) / 2) / std::sin((beta - alpha) / 2) / std::tan(theta / 2));
  // Denavit and Hartenberg: Rot_z(angle) Trans_x(length) Rot_x(twist).
  Frame frame;
  std::vector<Frame> hinges;
  const double angles[] = {theta, phi, -theta, -phi}, lengths[] = {a, b, a, b}, twists[] = {alpha, beta, alpha, beta};
  for (int k = 0; k < 4; ++k) {
    hinges.push_back(frame);
    const Matrix3 Z = exp_so3(Vector3(0, 0, angles[k]));
    frame.x += frame.R * Z * Vector3(lengths[k], 0, 0);
    frame.R = frame.R * Z * exp_so3(Vector3(twists[k], 0, 0));
  }
  REQUIRE(frame.x.norm() < 1e-12);
  REQUIRE((frame.R - Matrix3::Identity()).norm() < 1e-12);
  const char* names[] = {"one", "two", "three"};
  std::string nodes = "nodes:\n", elements = "elements:\n";
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 middle = 0.5 * (hinges[k].x + hinges[k + 1].x);
    nodes += as.node(names[k], middle.x(), middle.y(), middle.z());
    elements += as.body(names[k], 1 + static_cast<double>(k), {0.1, 0.2, 0.3});
  }
  const char* links[] = {"ground, one", "one, two", "two, three", "three, ground"};
  std::vector<std::string> joints;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3 z = hinges[k].R.col(2), &x = hinges[k].x;
    joints.push_back(as.joint(fmt::format("h{}", k), "hinge", links[k],
                              fmt::format("[{:.17g}, {:.17g}, {:.17g}]", z.x(), z.y(), z.z()), x.x(), x.y(), x.z()));
  }
  return as.gravity(1, 2, -9.81) + nodes + elements + as.joints(joints);
}

/// Returns squares of hinges in a row, each on the side of the one before: three redundant constraints each.
std::string squares(int count, const Variant& as) {
  std::string nodes = "nodes:\n", elements = "elements:\n";
  std::vector<std::string> joints;
  const auto body = [&](const std::string& name, double x, double y) {
    nodes += as.node(name, x, y, 0);
    elements += as.body(name, 1, {0.1, 0.1, 0.1});
  };
  for (int k = 0; k <= count; ++k) {
    const std::string arm = fmt::format("arm{}", k);
    body(arm, k, 0.5);
    joints.push_back(as.joint(fmt::format("foot{}", k), "hinge", "ground, " + arm, "[0, 0, 1]", k, 0, 0));
    if (k == 0) continue;
    const std::string bar = fmt::format("bar{}", k);
    body(bar, k - 0.5, 1);
    joints.push_back(
        as.joint(fmt::format("left{}", k), "hinge", fmt::format("arm{}, {}", k - 1, bar), "[0, 0, 1]", k - 1, 1, 0));
    joints.push_back(as.joint(fmt::format("right{}", k), "hinge", bar + ", " + arm, "[0, 0, 1]", k, 1, 0));
  }
  return as.gravity(1, -9.81, 2) + nodes + elements + as.joints(joints);
}

/// Returns the wrench of each joint's multipliers, in inertial axes about the attachment point on its second node, from
/// their terms in that node's equations.
MatrixX wrenches(const ReadyModel& model, const State& state) {
  const System& system = model.system;
  std::vector<const Joint*> joints;
  for (const Member& member : model.file.model.members())
    if (const auto* joint = dynamic_cast<const Joint*>(member.component.get())) joints.push_back(joint);
  MatrixX W = MatrixX::Zero(6 * static_cast<Eigen::Index>(joints.size()), system.multipliers());
  State probe = state;
  probe.reaction.resize(0);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Slots& slots = system.slots_of(*joints[j]);
    const LocalState local(probe, slots, model.environment());
    const NodeState& second = local.node(1);
    const Vector3 arm = second.R * joints[j]->frames().on_second.x;
    for (int k = 0; k < slots.multipliers; ++k) {
      probe.multiplier.setZero();
      probe.multiplier[slots.multiplier_begin + k] = 1;
      VectorX r = VectorX::Zero(slots.size());
      joints[j]->add_residual(local, r);
      const Vector3 force = -r.segment<3>(6), moment = -second.R * r.segment<3>(9) - arm.cross(force);
      W.col(slots.multiplier_begin + k).segment<6>(6 * static_cast<Eigen::Index>(j)) << force, moment;
    }
  }
  return W;
}

/// B^T over all constraints, (dofs, multipliers): derivatives of the residual, which is affine in multipliers.
MatrixX transposed_constraints(const ReadyModel& model, const State& state) {
  const System& system = model.system;
  State probe = state;
  probe.idle.assign(static_cast<std::size_t>(system.multipliers()), Idle::active);
  probe.multiplier.setZero();
  VectorX zero(system.size()), one(system.size());
  system.residual(probe, model.environment(), zero);
  MatrixX Bt(system.dofs(), system.multipliers());
  for (int k = 0; k < system.multipliers(); ++k) {
    probe.multiplier.setZero();
    probe.multiplier[k] = 1;
    system.residual(probe, model.environment(), one);
    Bt.col(k) = (one - zero).head(system.dofs());
  }
  return Bt;
}

State balanced(const ReadyModel& model, const State& state) {
  State result = state;
  ReactionNorm norm(model.system);
  norm.balance(model.environment(), result);
  return result;
}

/// Compares with  lambda + N z,  N the null space of B^T, z from the least squares of the weighted wrenches. @returns
/// the dimension of N
Eigen::Index check_smallest(const ReadyModel& model, const State& state) {
  const State found = balanced(model, state);
  REQUIRE(found.reaction.size() == model.system.multipliers());
  const double L = redundancy_arm(model.system, model.environment(), state);
  MatrixX W = wrenches(model, state);
  for (Eigen::Index row = 0; row < W.rows(); ++row)
    if (row % 6 >= 3) W.row(row) /= L;
  // Moments are divided by the arm, so that a small residual is small relative to forces.
  MatrixX Bt = transposed_constraints(model, state);
  for (int i = 0; i < model.system.dofs(); ++i)
    if (model.system.kind(i) == Kind::rotation) Bt.row(i) /= L;
  const VectorX column_size = Bt.colwise().norm();
  const bielle::RightSingularVectors singular =
      bielle::right_singular_vectors(Bt * column_size.cwiseInverse().asDiagonal());
  const Eigen::Index rank = (singular.values.array() > 1e-9 * singular.values[0]).count();
  const MatrixX N = column_size.cwiseInverse().asDiagonal() * singular.vectors.rightCols(Bt.cols() - rank);
  const VectorX z = bielle::least_squares(W * N, -W * state.multiplier);
  const VectorX expected = W * (state.multiplier + N * z);
  INFO("largest reaction " << expected.cwiseAbs().maxCoeff() << ", as written first "
                           << (W * state.multiplier).cwiseAbs().maxCoeff());
  CHECK((W * found.reaction - expected).cwiseAbs().maxCoeff() < 1e-8 * expected.cwiseAbs().maxCoeff());
  // The same forces on all.
  CHECK((Bt * (found.reaction - state.multiplier)).cwiseAbs().maxCoeff() < 1e-9 * expected.cwiseAbs().maxCoeff());
  // Multipliers that the null space changes are not unique.
  ReactionNorm norm(model.system);
  std::vector<int> moved;
  for (Eigen::Index k = 0; k < N.rows(); ++k)
    if (N.row(k).norm() * column_size[k] > 1e-7) moved.push_back(static_cast<int>(k));
  CHECK(norm.not_unique(model.environment(), state) == moved);
  return Bt.cols() - rank;
}

State moving(const ReadyModel& model) { return integrate(model, Scheme::generalized_alpha(0.8), 1e-3, 0.1); }

struct Case {
  const char* name;
  std::string (*text)(const Variant&);
  Eigen::Index redundant;
};
std::string forty_squares(const Variant& as) { return squares(40, as); }
const Case cases[] = {{"door", door, 5},
                      {"four-bar", four_bar, 3},
                      {"bar", bar, 4},  // 3 + 3 + 4 rows hold 6 directions
                      {"Bennett's loop", bennett, 3},
                      {"forty squares", forty_squares, 120}};

}  // namespace

TEST_CASE("reactions of smallest norm are those of dense algebra") {
  for (const Case& each : cases) {
    CAPTURE(each.name);
    const ReadyModel model(each.text({}));
    // The check is made at rest and during the motion.
    const State start =
        TimeIntegration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0))
            .state();
    CHECK(check_smallest(model, start) == each.redundant);
    if (each.redundant > 100) continue;  // half a minute
    CHECK(check_smallest(model, moving(model)) == each.redundant);
  }
}

TEST_CASE("in statics they are those of dense algebra, too") {
  const ReadyModel model(bar({}));
  State state = model.system.start(0);
  solve_statics(model.system, model.environment(), 1, {}, state);
  check_smallest(model, state);
}

TEST_CASE("equal hinges of a door share its weight equally, and its moment as the smallest norm has it") {
  // H d + 2 n = m g rho, min 2 d^2 + 2 n^2/L^2: d = m g rho H/(H^2 + 4 L^2), n = 2 d L^2/H.
  std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes: {door: {position: [0.4, 0, 0]}}
elements: {door: {type: rigid_body, node: door, mass: 20, inertia: [3, 4, 1]}}
joints:
  upper: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 0, 0.7], second_axis: [1, 0, 0]}
  lower: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 0, -0.7], second_axis: [1, 0, 0]}
)yaml";
  const ReadyModel model(text);
  const State start = balanced(
      model, TimeIntegration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0))
                 .state());
  const double L = redundancy_arm(model.system, model.environment(), start), H = 1.4, moment = 20 * 9.81 * 0.4,
               d = moment * H / (H * H + 4 * L * L), n = 2 * d * L * L / H, half = 10 * 9.81;
  const auto reaction = [&](const char* name) {
    const auto& joint = dynamic_cast<const Joint&>(*model.file.model.components_named(name).front());
    return joint.calc_reaction(LocalState(start, model.system.slots_of(joint), model.environment()));
  };
  Vector6 upper, lower;
  upper << -d, 0, half, 0, -n, 0;
  lower << d, 0, half, 0, -n, 0;
  CHECK((reaction("upper") - upper).norm() < 1e-8 * half);
  CHECK((reaction("lower") - lower).norm() < 1e-8 * half);
}

namespace {

/// Returns the reported wrenches in inertial axes by the joints' names, in the first units.
std::map<std::string, Vector6> reported(const Case& each, const Variant& as, bool on_the_way) {
  const ReadyModel model(each.text(as));
  State state = on_the_way ? moving(model)
                           : TimeIntegration(model.system, model.environment(), Scheme::generalized_alpha(0.8),
                                             model.system.start(0))
                                 .state();
  state = balanced(model, state);
  std::map<std::string, Vector6> result;
  for (const Member& member : model.file.model.members()) {
    const auto* joint = dynamic_cast<const Joint*>(member.component.get());
    if (!joint) continue;
    const LocalState local(state, model.system.slots_of(*joint), model.environment());
    const Matrix3 axes = local.node(0).R * joint->frames().on_first.R;
    const Vector6 wrench = joint->calc_reaction(local);
    const double force = as.mass * as.length, moment = force * as.length;
    result[joint->name()] << axes * wrench.head<3>() / force, axes * wrench.tail<3>() / moment;
  }
  return result;
}

}  // namespace

TEST_CASE("reported reactions depend on no order, axes, origin or units") {
  Variant reversed, axes, shifted, units, all;
  reversed.reversed = all.reversed = true;
  axes.second_axis = all.second_axis = {0.3, -0.5, 0.4};
  shifted.shift = all.shift = {10, -7, 3};
  units.length = all.length = 1e3;
  units.mass = all.mass = 1e3;
  for (const Case& each : cases) {
    if (each.redundant > 100) continue;
    for (const bool on_the_way : {false, true}) {
      const auto expected = reported(each, {}, on_the_way);
      double size = 0;
      for (const auto& [name, wrench] : expected) size = std::max(size, wrench.norm());
      const std::pair<const char*, Variant> variants[] = {
          {"reversed", reversed}, {"axes", axes}, {"shifted", shifted}, {"units", units}, {"all", all}};
      for (const auto& [what, as] : variants) {
        const auto found = reported(each, as, on_the_way);
        REQUIRE(found.size() == expected.size());
        for (const auto& [name, wrench] : expected) {
          CAPTURE(each.name, what, on_the_way, name, wrench.transpose(), found.at(name).transpose());
          // On the way: Newton's tolerance, 1e-9 of forces, over the step's compliance.
          CHECK((found.at(name) - wrench).norm() < (on_the_way ? 1e-6 : 1e-8) * size);
        }
      }
    }
  }
}

TEST_CASE("where nothing is redundant nothing is paid and all reactions are unique") {
  const ReadyModel model(R"yaml(
gravity: [0, -9.81, 0]
nodes: {bob: {position: [1, 0, 0]}}
elements: {bob: {type: rigid_body, node: bob, mass: 2, inertia: [1, 1, 1]}}
joints: {pivot: {type: hinge, nodes: [ground, bob], axis: [0, 0, 1], position: [0, 0, 0]}}
)yaml");
  const State state = moving(model);
  CHECK_FALSE(ReactionNorm::needed(model.system, state));
  CHECK(state.reaction.size() == 0);
  ReactionNorm norm(model.system);
  State same = state;
  same.reaction = VectorX::Ones(model.system.multipliers());  // reactions of another state
  norm.balance(model.environment(), same);
  CHECK(same.reaction.size() == 0);
  CHECK(norm.not_unique(model.environment(), state).empty());
}

}  // namespace test_reaction_norm
