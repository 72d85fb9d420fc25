// A path of equilibria with condensed amplitudes: the same points, in as many iterations, as without.
#include <catch2/catch.hpp>

#include "mechanism/solvers/statics/arc_length.hpp"
#include "tests/support/superelement_arms.hpp"

using namespace bielle::mechanism;
using bielle::test::ArmsSystem;
using bielle::test::SuperelementArms;

TEST_CASE("a path of equilibria is the same with condensed amplitudes") {
  const SuperelementArms arms;
  struct Path {
    State state;
    std::vector<PathPoint> points;
  };
  const auto follow = [](const ArmsSystem& of) {
    Path path;
    path.state = of.system.start(0);
    ContinuationOptions options;
    options.end.load_factor = 1;
    options.steps = 4;
    follow_by_continuation(of.system, of.file.model.environment, {}, options, NewtonOptions{}, path.state,
                           [&](const State&, const PathPoint& point) { path.points.push_back(point); });
    return path;
  };
  const ArmsSystem condensed(arms, true), whole(arms, false);
  REQUIRE(condensed.system.condensed_pattern().blocks().size() == 2);
  REQUIRE(whole.system.condensed_pattern().blocks().empty());
  const Path a = follow(condensed), b = follow(whole);
  REQUIRE(a.points.size() == b.points.size());
  constexpr double tolerance = 1e-8;  // Newton's tolerance is 1e-9 of the forces
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    CHECK(std::abs(a.points[k].load_factor - b.points[k].load_factor) < tolerance);
    CHECK(a.points[k].iterations == b.points[k].iterations);
  }
  for (std::size_t k = 0; k < a.state.nodes.size(); ++k)
    CHECK((a.state.nodes[k].x - b.state.nodes[k].x).norm() < tolerance);
  CHECK((a.state.amplitude - b.state.amplitude).norm() < tolerance * b.state.amplitude.norm());
  CHECK((b.state.nodes.back().x - whole.system.start(0).nodes.back().x).norm() > 0.01);  // it bends
}
