// The flying spaghetti at late times, where errors have grown, and at times when they nearly cancel.
#include "tests/benchmarks/beams/flying_spaghetti.hpp"

using namespace bielle::mechanism;
using namespace bielle::test::spaghetti;
using bielle::test::ReadyModel;

TEST_CASE("flying spaghetti in the plane at late times converges to the reference") {
  check(100, true, 0.01, {{15, {32.425897, 4.518096, 0}, {23.771001, 5.922268, 0}}}, 5e-4);
  check(500, true, 0.01, {{15, {25.6901515, -0.4332959, 0}, {30.1902357, 8.4949399, 0}}}, 5e-4);
}

TEST_CASE("flying spaghetti in space at a late time converges to the reference") {
  check(500, false, 0.005, {{10, {44.402384, 1.669030, -2.065274}, {36.408950, 6.335486, 1.678987}}}, 5e-4);
}

TEST_CASE("flying spaghetti in the plane at a late time: its middle, too") {
  std::vector<Vector3> errors;
  for (const int level : {1, 2})
    fly(16 << level, 100, true, 0.01 / (1 << level), {15},
        [&](const ReadyModel& model, const State& state, std::size_t) {
          errors.push_back(model.node(state, fmt::format("s.{}", 8 << level)).x - Vector3(27.802573, 3.041078, 0));
        });
  CHECK(((4 * errors[1] - errors[0]) / 3).norm() < 5e-4);
}

TEST_CASE("flying spaghetti: the loaded end at times when errors of elements and steps nearly cancel") {
  const auto extrapolated = [](bool plane, double time, const Vector3& exact) {
    std::vector<Vector3> errors;
    for (const int level : {1, 2})
      fly(16 << level, 500, plane, 0.01 / level, {time}, [&](const ReadyModel& model, const State& state, std::size_t) {
        errors.push_back(model.node(state, "a").x - exact);
      });
    CAPTURE(errors[0].transpose(), errors[1].transpose());
    CHECK(errors[1].norm() < 2e-3);
    return ((4 * errors[1] - errors[0]) / 3).norm();
  };
  CHECK(extrapolated(true, 5, {4.29940117, 0.64024815, 0}) < 5e-5);
  CHECK(extrapolated(false, 3.5, {4.7692447, 3.0617638, -2.8014768}) < 5e-4);
}
