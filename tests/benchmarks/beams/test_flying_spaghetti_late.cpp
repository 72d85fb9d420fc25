// The flying spaghetti at late times, where errors have grown, and at times when they nearly cancel.
#include "tests/benchmarks/beams/flying_spaghetti.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using namespace bielle::test::spaghetti;
using bielle::test::ReadyModel;

TEST_CASE("flying spaghetti in the plane at late times converges to the reference") {
  check(100, true, 0.01, {15}, 5e-4);
  check(500, true, 0.01, {15}, 5e-4);
}

TEST_CASE("flying spaghetti in space at a late time converges to the reference") {
  check(500, false, 0.005, {10}, 5e-4);
}

TEST_CASE("flying spaghetti in the plane at a late time: its middle, too") {
  const Vector3 exact = bielle::test::ReferenceTable("flying_spaghetti").vector("plane_100.15.middle");
  std::vector<Vector3> errors;
  for (const int level : {1, 2})
    fly(16 << level, 100, true, 0.01 / (1 << level), {15},
        [&](const ReadyModel& model, const State& state, std::size_t) {
          errors.push_back(model.node(state, fmt::format("s.{}", 8 << level)).x - exact);
        });
  CHECK(((4 * errors[1] - errors[0]) / 3).norm() < 5e-4);
}

TEST_CASE("flying spaghetti: the loaded end at times when errors of elements and steps nearly cancel") {
  const auto extrapolated = [](bool plane, double time) {
    const Vector3 exact =
        bielle::test::ReferenceTable("flying_spaghetti").vector(fmt::format("{}.{}.a", name_of(500, plane), time));
    std::vector<Vector3> errors;
    for (const int level : {1, 2})
      fly(16 << level, 500, plane, 0.01 / level, {time}, [&](const ReadyModel& model, const State& state, std::size_t) {
        errors.push_back(model.node(state, "a").x - exact);
      });
    CAPTURE(errors[0].transpose(), errors[1].transpose());
    CHECK(errors[1].norm() < 2e-3);
    return ((4 * errors[1] - errors[0]) / 3).norm();
  };
  CHECK(extrapolated(true, 5) < 5e-5);
  CHECK(extrapolated(false, 3.5) < 5e-4);
}
