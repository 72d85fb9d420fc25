// The mean-axis frame: its conditions, its invariance under rigid motions of any size, its differentials.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "mechanism/elements/superelement/frame_conditions.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/superelement_alone.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

std::vector<Matrix3> turned_nodes(Random& random) {
  return {exp_so3(random.vector3(2)), exp_so3(random.vector3(2)), exp_so3(random.vector3(2))};
}

}  // namespace

TEST_CASE("a rigidly moved body has its rigid frame, through half turns and many turns") {
  Random random(1);
  for (const BeamChain& chain : bent_chains()) {
    const SuperelementAlone alone(chain.reduced().body, turned_nodes(random));
    for (double angle : {0.0, 1e-8, 1.0, M_PI - 1e-9, M_PI, 4.0, 100.0}) {
      const Frame frame{random.vector3(5), exp_so3(random.vector_of_length(angle))};
      const CorotatedGeometry geometry = alone.geometry(alone.rigid_state(frame));
      // Positions of size 8 in double precision.
      CHECK(error(geometry.frame.x, frame.x) < 2e-14);
      CHECK(error(geometry.frame.R, frame.R) < 2e-14);
      CHECK(geometry.q.cwiseAbs().maxCoeff() < 2e-14);
    }
  }
}

TEST_CASE("local displacements in the frame have no mean rigid motion and do not see rigid motions") {
  Random random(2);
  for (const BeamChain& chain : bent_chains())
    for (double deformation : {1e-8, 0.01, 0.3}) {
      const SuperelementAlone alone(chain.reduced().body, turned_nodes(random));
      const State state = alone.random_state(random, deformation, 0);
      const CorotatedGeometry geometry = alone.geometry(state);
      const double size = alone.body().frame().A_transposed().norm();
      CHECK((alone.body().frame().A_transposed() * geometry.q).norm() < 1e-14 * size);

      const Frame motion{random.vector3(5), exp_so3(random.vector3(3))};
      State elsewhere = state;
      for (NodeState& node : elsewhere.nodes) {
        node.x = motion.x + motion.R * node.x;
        node.R = motion.R * node.R;
      }
      const CorotatedGeometry moved = alone.geometry(elsewhere);
      CHECK(error(moved.frame.x, motion.x + motion.R * geometry.frame.x) < 5e-14);
      CHECK(error(moved.frame.R, motion.R * geometry.frame.R) < 5e-14);
      CHECK(error(moved.q, geometry.q) < 5e-14);
    }
}

TEST_CASE("differentials of the frame and of the local coordinates hold against finite differences") {
  Random random(3);
  for (const BeamChain& chain : bent_chains())
    for (double deformation : {0.0, 1e-8, 0.01, 0.2}) {
      CAPTURE(deformation);
      const SuperelementAlone alone(chain.reduced().body, turned_nodes(random));
      const State state = alone.random_state(random, deformation, 0);
      const CorotatedGeometry geometry = alone.geometry(state);
      const Matrix3 R_0t = geometry.frame.R.transpose();
      const VectorX direction = random.vector(alone.size());
      // D dz^ in the frame's layout
      VectorX D_dz = VectorX::Zero(geometry.q.size());
      const auto& points = alone.body().frame().points();
      for (std::size_t k = 0; k < points.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(6 * k);
        D_dz.segment<3>(points[k].u) = R_0t * direction.segment<3>(row);
        if (points[k].theta >= 0)
          D_dz.segment<3>(points[k].theta) = geometry.D[k] * R_0t * state.nodes[k].R * direction.segment<3>(row + 3);
      }
      D_dz.tail(chain.modes) = direction.tail(chain.modes);
      const Vector6 dnu = geometry.Sigma * D_dz;
      const auto at = [&](double s) { return alone.geometry(alone.moved(state, s * direction)); };
      // The frame of a bent, loosely held body varies on a scale of 0.1: differences of this step are within 1e-11, of
      // twice the step 64 times farther.
      constexpr double difference = 1e-10, step = 0.0025;
      CHECK(error(derivative([&](double s) { return Vector3(R_0t * at(s).frame.x); }, step), dnu.head<3>()) <
            difference);
      CHECK(error(derivative([&](double s) { return Vector3(skew_vector(R_0t * at(s).frame.R)); }, step),
                  dnu.tail<3>()) < difference);
      CHECK(error(derivative([&](double s) { return at(s).q; }, step), D_dz - geometry.V * dnu) < difference);
    }
}

TEST_CASE("a node that spins about a free axis does not move the frame") {
  Random random(4);
  const BeamChain chain = bent_chains()[2];
  const SuperelementAlone alone(chain.reduced().body);
  const State state = alone.random_state(random, 0.05, 0);
  const CorotatedGeometry geometry = alone.geometry(state);
  State spun = state;
  spun.nodes[1].R = spun.nodes[1].R * exp_so3({0, 0, 2.8});  // interface b: axes of the body, free about z
  const CorotatedGeometry same = alone.geometry(spun);
  CHECK(error(same.q, geometry.q) < 1e-14);
  CHECK(error(same.frame.R, geometry.frame.R) < 1e-14);
}

TEST_CASE("nodes far from any placement of the body are refused with a sentence") {
  const SuperelementAlone alone(straight_beam().reduced().body);
  State state = alone.rigid_state({});
  state.nodes[0].x.setConstant(std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(alone.residual(state), bielle::ComputationError);
  CHECK_THROWS_WITH(alone.residual(state),
                    Catch::Contains("superelement 'alone': the positions of its interfaces are no"));
  // With a geometric stiffness far beyond that of a beam, a position soon has two deformations, or none.
  bielle::Superelement tense = straight_beam().reduced().body;
  for (MatrixX& stiffness : tense.load_stiffness) stiffness *= 100;
  const SuperelementAlone beyond(tense);
  state = beyond.rigid_state({});
  state.nodes[1].x.x() += 0.5;
  state.nodes[1].R = exp_so3({0.1, 0.2, 0.3});
  const std::string refusal = [&] {
    try {
      beyond.residual(state);
    } catch (const bielle::ComputationError& error) {
      return std::string(error.what());
    }
    return std::string();
  }();
  CHECK_THAT(refusal, Catch::Contains("deformed beyond what the theory of second order describes") &&
                          Catch::Contains("too soft"));
}

TEST_CASE("a frame carried by an interface stands on its node, and needs all its directions") {
  Random random(5);
  const BeamChain chain = bent_chains()[2];
  const SuperelementAlone alone(chain.reduced().body);
  const State state = alone.random_state(random, 0.1, 0);
  const SuperelementMatrices& matrices = alone.body().matrices();
  const CorotatedFrame carried(alone.body().frame().points(), carried_conditions(matrices, 0), 1);
  CorotatedGeometry geometry;
  carried.solve(alone.local(state), geometry);
  const BodyPoint& point = carried.points()[0];
  CHECK(error(geometry.frame.x + geometry.frame.R * point.X, state.nodes[0].x) < 1e-14);
  CHECK(error(geometry.frame.R * point.R_ref, state.nodes[0].R) < 1e-14);
  CHECK_THROWS_WITH(carried_conditions(matrices, 1), Catch::Contains("must keep all its translations and rotations"));
}

TEST_CASE("bodies with one interface, and with two that coincide, have a frame") {
  Random random(6);
  BeamChain one = straight_beam();
  one.interfaces = {{7}};
  {
    const SuperelementAlone alone(one.reduced().body);
    const State state = alone.random_state(random, 0.1, 0);
    const CorotatedGeometry geometry = alone.geometry(state);
    CHECK(geometry.q.head<6>().norm() < 1e-14);
    CHECK(error(geometry.frame.R, state.nodes[0].R) < 1e-14);
  }
  // A ring closes at its beginning: both ends of the chain are at one place.
  BeamChain ring = bent_chain();
  ring.nodes.clear();
  for (int k = 0; k <= 16; ++k)
    ring.nodes.emplace_back(std::cos(k * M_PI / 8), std::sin(k * M_PI / 8), 0.1 * std::sin(k * M_PI / 16));
  ring.y_direction = {0, 0, 1};
  ring.interfaces = {{0}, {16}};
  ring.loads.clear();
  const SuperelementAlone alone(ring.reduced().body);
  const State state = alone.random_state(random, 0.02, 0);
  const CorotatedGeometry geometry = alone.geometry(state);
  CHECK((alone.body().frame().A_transposed() * geometry.q).norm() < 1e-13);
  const State rigid = alone.rigid_state({random.vector3(2), exp_so3(random.vector3(3))});
  CHECK(alone.residual(rigid).norm() < 1e-11);
}
