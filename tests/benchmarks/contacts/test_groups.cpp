// Groups of many shapes: pairs that are far from each other do not change the result.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/balls_on_floor.hpp"

using namespace bielle::mechanism;
using bielle::test::BallsOnFloor;

namespace {

std::vector<double> heights(const BallsOnFloor& balls, double duration) {
  const MechanismFile file = read_mechanism_text(balls.text(), "balls.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = duration;
  options.stepping.size = 5e-4;
  Motion motion = session.dynamics(options);
  motion.finish();
  std::vector<double> z;
  for (int k = 0; k < balls.along * balls.along; ++k) z.push_back(session.node(fmt::format("b{}", k)).x.z());
  z.push_back(session.read("contacts/it/state")[0]);
  return z;
}

}  // namespace

TEST_CASE("balls that are apart move the same in one group as each with the floor alone") {
  BallsOnFloor group, alone;
  group.along = alone.along = 6;
  alone.group = false;
  const std::vector<double> a = heights(group, 0.2), b = heights(alone, 0.2);
  REQUIRE(a.back() > 5);
  for (std::size_t k = 0; k < a.size(); ++k) CHECK_THAT(a[k], Catch::WithinAbs(b[k], 1e-10));
}

TEST_CASE("a heap of balls settles in its bin, and none leaves it") {
  BallsOnFloor balls;
  balls.along = 6;
  balls.heap = true;
  const std::vector<double> z = heights(balls, 1);
  CHECK(z.back() > 36);
  for (int k = 0; k < 36; ++k) CHECK(z[static_cast<std::size_t>(k)] > 0.049);
}

TEST_CASE("a heap that is restored goes on as it did, to the last bit") {
  BallsOnFloor balls;
  balls.along = 4;
  balls.heap = true;
  balls.law = "    stiffness: 1e6\n    restitution: 0.5\n    friction: {coefficient: 0.3, velocity: 0.01}\n";
  const MechanismFile file = read_mechanism_text(balls.text(), "balls.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = 0.3;
  options.stepping.size = 5e-4;
  const auto places = [&] {
    std::vector<double> all;
    for (const NodeState& node : session.state().nodes) all.insert(all.end(), {node.x.x(), node.x.y(), node.x.z()});
    return all;
  };
  Motion motion = session.dynamics(options);
  motion.advance_to(0.2);
  REQUIRE(session.read("contacts/it/state")[0] > 0);
  const std::vector<double> saved = session.save();
  motion.finish();
  const std::vector<double> end = places();
  session.restore(saved);
  CHECK(places() != end);
  motion.finish();
  CHECK(places() == end);
}

TEST_CASE("the error in the energy balance of a heap with a restitution falls with the square of the steps") {
  // There are about 120 impacts of 8 ms. Friction and the damping of the impacts dissipate 9 of 10 J.
  BallsOnFloor balls;
  balls.along = 6;
  balls.heap = true;
  balls.law = "    stiffness: 1e6\n    restitution: 0.5\n    friction: {coefficient: 0.3, velocity: 0.01}\n";
  const MechanismFile file = read_mechanism_text(balls.text(), "balls.yaml");
  double missing[2];
  for (const int k : {0, 1}) {
    Session session(file.model);
    DynamicsOptions options;
    options.duration = 0.4;
    options.stepping.size = 5e-4 / (1 << k);
    Motion motion = session.dynamics(options);
    double dissipated = 0, taken_back = 0;
    while (motion.step()) {
      taken_back = std::max(taken_back, dissipated - motion.energy().dissipation);
      dissipated = motion.energy().dissipation;
    }
    CHECK(motion.log().crossings > 50);
    CHECK(dissipated > 5);
    CHECK(taken_back < 1e-12 * dissipated);  // damping and friction never supply energy
    missing[k] = std::abs(motion.balance());
  }
  CHECK(missing[0] < 0.01 * 10);
  CHECK(missing[0] / missing[1] > 3);
}
