// Coordinates and reactions of joints, with all their derivatives, against finite differences at random states.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/joints/joint.hpp"
#include "mechanism/system/system.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::jacobian;
using bielle::test::Random;

namespace {

constexpr const char* all_joints = R"yaml(
nodes:
  a: {position: [0.4, 0.1, 0], rotation_vector: [0.3, -0.5, 0.2]}
  b: {position: [1.2, 0.2, 0.1], rotation_vector: [0.1, 0.7, -0.4]}
elements: {a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}}
joints:
  hinge: {type: hinge, nodes: [a, b], axis: [0.2, 1, -0.3], position: [0.8, 0.2, 0.1]}
  prismatic: {type: prismatic, nodes: [a, b], axis: [0.2, 1, -0.3]}
  cylindrical: {type: cylindrical, nodes: [a, b], axis: [1, 0.1, -0.3]}
  planar: {type: planar, nodes: [a, b], axis: [1, 0.1, 0.4]}
  spherical: {type: spherical, nodes: [a, b], axis: [1, 0.5, -0.3], position: [0.7, 0.3, -0.1]}
  rigid: {type: rigid, nodes: [a, b], position: [0.7, 0.3, -0.1]}
  bushing: {type: bushing, nodes: [a, b], axis: [1, 0.5, -0.3], position: [0.7, 0.3, -0.1], stiffness: [1, 2, 3, 1, 2, 3], damping: [1, 2, 1, 0.5, 0.3, 1]}
  bearing: {type: bearing, nodes: [a, b], axis: [1, 0.5, -0.3], radial: {stiffness: 2, damping: 1}, axial: 1, tilting: 1}
  clearance:
    {type: clearance_hinge, nodes: [a, b], axis: [1, 0.5, -0.3], radial_gap: 1e-3, length: 0.3, radius: 0.2, contact: {stiffness: 2, exponent: 2, damping: 0.1},
     friction: {coefficient: 0.3, velocity: 2}}
)yaml";

struct Joints {
  MechanismFile file = read_mechanism_text(all_joints, "joints.yaml");
  std::unique_ptr<System> system = std::make_unique<System>(file.model);
  explicit Joints(bool carried_axes) {
    if (!carried_axes) system->set_aside({});
  }
  std::vector<const Joint*> all() const {
    std::vector<const Joint*> joints;
    for (const Member& member : file.model.members())
      if (const auto* joint = dynamic_cast<const Joint*>(member.component.get())) joints.push_back(joint);
    return joints;
  }
  LocalState local(const Joint& joint, const State& state) const {
    return {state, system->slots_of(joint), file.model.environment};
  }
};

/// Returns a state with both nodes anywhere and rotated at random; rates and multipliers are of order one.
State random_state(const System& system, Random& random) {
  State state = system.start(0);
  for (std::size_t k = 1; k < state.nodes.size(); ++k) {
    NodeState& node = state.nodes[k];
    node.x += random.vector3();
    node.R = node.R * exp_so3(Vector3(random.vector_of_length(1.2)));
    node.v = random.vector3();
    node.Omega = random.vector3();
  }
  state.multiplier = random.vector(system.multipliers());
  return state;
}

/// Returns the state moved along the local unknowns of a joint without scalars but its multipliers.
State moved(const LocalState& local, const VectorX& step) {
  State state = local.global();
  const Slots& slots = local.slots();
  for (std::size_t k = 0; k < slots.nodes.size(); ++k) {
    NodeState& node = state.nodes[static_cast<std::size_t>(slots.nodes[k])];
    const auto at = 6 * static_cast<Eigen::Index>(k);
    node.x += step.segment<3>(at);
    node.R = node.R * exp_so3(Vector3(step.segment<3>(at + 3)));
  }
  state.multiplier.segment(slots.multiplier_begin, slots.multipliers) += step.tail(slots.multipliers);
  return state;
}

/// Checks g, S, w, W of every coordinate. @param accurate  accuracy of derivatives of order one
void check_coordinates(const Joints& joints, const Joint& joint, const State& state, double accurate, double h) {
  const LocalState local = joints.local(joint, state);
  const auto n = static_cast<Eigen::Index>(local.slots().size());
  for (std::size_t k = 0; k < joint.coordinates().size(); ++k) {
    CAPTURE(joint.type(), joint.coordinates()[k].name);
    CoordinateDerivatives jet;
    joint.calc_coordinate(k, local, jet);
    const auto at = [&](const VectorX& step, const auto& read) -> VectorX {
      const State there = moved(local, step);
      CoordinateDerivatives other;
      joint.calc_coordinate(k, joints.local(joint, there), other);
      return read(other);
    };
    const MatrixX g = jacobian(
        [&](const VectorX& s) {
          return at(s, [](CoordinateDerivatives& j) -> VectorX { return VectorX::Constant(1, j.value); });
        },
        n, h);
    const MatrixX S = jacobian(
        [&](const VectorX& s) { return at(s, [](CoordinateDerivatives& j) -> VectorX { return j.g(); }); }, n, h);
    const MatrixX W = jacobian(
        [&](const VectorX& s) { return at(s, [](CoordinateDerivatives& j) -> VectorX { return j.w(); }); }, n, h);
    CHECK((g.transpose() - jet.g()).cwiseAbs().maxCoeff() < accurate);
    CHECK((S - jet.S()).cwiseAbs().maxCoeff() < accurate * std::max(1.0, S.cwiseAbs().maxCoeff()));
    CHECK((W - jet.W()).cwiseAbs().maxCoeff() < accurate);
    CoordinateSlopes slopes;
    joint.calc_slopes(k, local, slopes);
    CHECK((slopes.g() - jet.g()).isZero(1e-14));
    CHECK((slopes.w() - jet.w()).isZero(1e-14));
    CHECK_THAT(slopes.value, Catch::WithinAbs(jet.value, 1e-14));
    CHECK_THAT(slopes.principal, Catch::WithinAbs(jet.principal, 1e-14));
    CHECK_THAT(slopes.rate, Catch::WithinAbs(jet.rate, 1e-13));
    // The rate is w . v, and the values computed without derivatives are the same.
    VectorX v(n);
    get_local_velocities(local, v);
    CHECK_THAT(jet.rate, Catch::WithinAbs(jet.w().dot(v), 1e-13));
    const CoordinateRate plain = joint.coordinate(k, local);
    CHECK_THAT(jet.value, Catch::WithinAbs(plain.value, 1e-13));
    CHECK_THAT(jet.rate, Catch::WithinAbs(plain.rate, 1e-13));
    if (joint.coordinates()[k].kind != JointCoordinate::Kind::rotation) CHECK((jet.g() - jet.w()).isZero(0));
  }
}

}  // namespace

TEST_CASE("coordinates of joints have the derivatives that finite differences find") {
  Random random(3);
  for (const bool carried_axes : {true, false}) {
    const Joints joints(carried_axes);
    for (int sample = 0; sample < 5; ++sample) {
      const State state = random_state(*joints.system, random);
      for (const Joint* joint : joints.all()) {
        // Angles about an axis vary fast where the axes are far apart: turned by 1 rad at most.
        const double most = joint->type() == "spherical" ? 2 : 1;
        State near = state;
        const NodeState& first = near.nodes[static_cast<std::size_t>(joint->frames().first)];
        near.nodes[static_cast<std::size_t>(joint->frames().second)].R =
            first.R * joint->frames().on_first.R *
            exp_so3(Vector3(random.vector_of_length(random.uniform(0.3, most)))) *
            joint->frames().on_second.R.transpose();
        check_coordinates(joints, *joint, near, 1e-9, 0.01);
      }
    }
  }
}

TEST_CASE("rotation vectors have their derivatives near zero and near half a turn") {
  Random random(5);
  const Joints joints(true);
  const Joint* ball = nullptr;
  for (const Joint* joint : joints.all())
    if (joint->type() == "spherical") ball = joint;
  for (const double angle : {0.0, 1e-12, 1e-8, 1e-5, 1e-3, 0.05, 3.0, 3.1, 3.14}) {
    State state = random_state(*joints.system, random);
    const NodeState& first = state.nodes[static_cast<std::size_t>(ball->frames().first)];
    const Vector3 psi = random.vector_of_length(angle);
    state.nodes[static_cast<std::size_t>(ball->frames().second)].R =
        first.R * ball->frames().on_first.R * exp_so3(psi) * ball->frames().on_second.R.transpose();
    CAPTURE(angle);
    const LocalState local = joints.local(*ball, state);
    for (std::size_t k = 0; k < 3; ++k)
      CHECK_THAT(ball->coordinate(k, local).value, Catch::WithinAbs(psi[static_cast<Eigen::Index>(k)], 1e-7));
    // The difference steps stay below half a turn, with 2 h in two rotations. The accuracy of differences is limited by
    // the rounding of log_so3 there, 1e-8 in the worst case (see test_rotation_singularities.cpp), divided by h.
    const double left = M_PI - angle, h = std::min(0.02, 0.2 * left);
    check_coordinates(joints, *ball, state, std::max(1e-9, 1e-12 / h), h);
  }
}

TEST_CASE("reactions of joints have the derivatives that finite differences find, in row axes of both kinds") {
  Random random(7);
  for (int sample = 0; sample < 5; ++sample)
    for (const bool carried_axes : {true, false}) {
      const Joints joints(carried_axes);
      const State state = random_state(*joints.system, random);
      for (const Joint* joint : joints.all()) {
        CAPTURE(joint->type(), carried_axes);
        const LocalState local = joints.local(*joint, state);
        MatrixX derivatives;
        const Vector6 reaction = joint->calc_reaction(local, derivatives);
        CHECK((reaction - joint->calc_reaction(local)).norm() < 1e-13);
        if (local.slots().multipliers > 0)
          CHECK((reaction - joint->reaction_of_multipliers(local) * local.multiplier()).norm() < 1e-13);
        // Directions across a journal's axis turn with steps over its distance from the bush's, which may be small.
        const double h = joint->type() == "clearance_hinge" ? 0.005 : bielle::test::difference_step;
        const MatrixX expected = jacobian(
            [&](const VectorX& step) -> VectorX {
              const State there = moved(local, step);
              return joint->calc_reaction(joints.local(*joint, there));
            },
            local.slots().size(), h);
        CHECK((derivatives - expected).cwiseAbs().maxCoeff() < 1e-10);
        if (!joint->reaction_has_rates()) continue;
        joint->calc_reaction_by_rates(local, derivatives);
        const MatrixX by_rates = jacobian(
            [&](const VectorX& step) -> VectorX {
              State there = state;
              for (const int k : {0, 1}) {
                NodeState& node =
                    there.nodes[static_cast<std::size_t>(local.slots().nodes[static_cast<std::size_t>(k)])];
                node.v += step.segment<3>(6 * k);
                node.Omega += step.segment<3>(6 * k + 3);
              }
              return joint->calc_reaction(joints.local(*joint, there));
            },
            local.slots().size());
        CHECK((derivatives - by_rates).cwiseAbs().maxCoeff() < 1e-10);
      }
    }
}

TEST_CASE("the reaction is what the joint does to its second node, about the attachment point, along its axes") {
  Random random(9);
  const Joints joints(true);
  State state = random_state(*joints.system, random);
  for (const Joint* joint : joints.all()) {
    CAPTURE(joint->type());
    const LocalState local = joints.local(*joint, state);
    VectorX r = VectorX::Zero(local.slots().size());
    joint->add_residual(local, r);
    const NodeState &first = local.node(0), &second = local.node(1);
    const Matrix3 axes = first.R * joint->frames().on_first.R;
    const Vector3 arm = second.R * joint->frames().on_second.x, force = -r.segment<3>(6),
                  moment = -second.R * r.segment<3>(9) - arm.cross(force);
    const Vector6 reaction = joint->calc_reaction(local);
    CHECK((axes * reaction.head<3>() - force).norm() < 1e-13);
    CHECK((axes * reaction.tail<3>() - moment).norm() < 1e-13);
    // Action equals reaction: there is no resultant force and no resultant moment on both nodes together.
    CHECK((r.segment<3>(0) + r.segment<3>(6)).norm() < 1e-13);
    const Vector3 moments = first.R * r.segment<3>(3) + second.R * r.segment<3>(9) +
                            first.x.cross(Vector3(r.segment<3>(0))) + second.x.cross(Vector3(r.segment<3>(6)));
    CHECK(moments.norm() < 1e-12);
  }
}

TEST_CASE("in row axes of both kinds one wrench is one wrench") {
  Random random(13);
  const Joints carried(true), inertial(false);
  const State state = random_state(*carried.system, random);
  for (const Joint* joint : carried.all()) {
    if (joint->type() != "hinge" && joint->type() != "spherical" && joint->type() != "rigid") continue;
    const Joint& other = dynamic_cast<const Joint&>(*inertial.file.model.components_named(joint->name()).front());
    const LocalState local = carried.local(*joint, state);
    // The forces of the rows that ride on the first node, written in inertial axes.
    State same = state;
    const Slots& slots = inertial.system->slots_of(other);
    const MatrixX to = inertial.local(other, state).slots().multipliers > 0
                           ? other.reaction_of_multipliers(inertial.local(other, state))
                           : MatrixX();
    const Vector6 wrench = joint->calc_reaction(local);
    same.multiplier.segment(slots.multiplier_begin, slots.multipliers) = bielle::least_squares(to, wrench);
    CAPTURE(joint->type());
    // Reactions of one kind of rows are possible with the other kind, too.
    CHECK((other.calc_reaction(inertial.local(other, same)) - wrench).norm() < 1e-12 * wrench.norm());
  }
}
