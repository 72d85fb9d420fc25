// Motions of condensed superelements continue a saved state to the last bit, for any number of threads.
#include "swinging_arms.hpp"
#include <catch2/catch.hpp>

#include "tests/support/superelement_arms.hpp"

using namespace bielle::mechanism;
using bielle::test::all_numbers;
using bielle::test::SuperelementArms;
using bielle::test::swing;

TEST_CASE("a motion with condensed amplitudes goes on as it did, in any number of threads") {
  const SuperelementArms arms;
  Session session(arms.file().model);
  REQUIRE(session.system().condensed_pattern().blocks().size() == 2);
  Motion motion = session.dynamics(swing(0.06));
  motion.advance_to(0.03);
  const std::vector<double> saved = session.save();
  motion.finish();
  const std::vector<double> end = all_numbers(session);
  for (const int threads : {1, 3}) {
    Session other(arms.file().model, threads);
    Motion again = other.dynamics(swing(0.06), saved);
    again.finish();
    CHECK(all_numbers(other) == end);
    Session undisturbed(arms.file().model, threads);
    Motion whole = undisturbed.dynamics(swing(0.06));
    whole.advance_to(0.03);
    undisturbed.save();  // a stop leaves a point to go on from, which has its part in the rounding
    whole.finish();
    CHECK(all_numbers(undisturbed) == end);
  }
}
