// The stored past of a value: interpolation within and beyond the stored times, jumps, and the size of the memory.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/measures/value_history.hpp"

using namespace bielle;
using namespace bielle::mechanism;

namespace test_value_history {

VectorX empty(const ValueHistory& history) { return VectorX::Zero(static_cast<Eigen::Index>(history.memory_size())); }

}  // namespace test_value_history
using namespace test_value_history;

TEST_CASE("the past of a value reproduces parabolas, within steps and beyond the last one") {
  const ValueHistory history(0.5, 20);
  VectorX memory = empty(history);
  const auto y = [](double t) { return 2 - 3 * t + 4 * t * t; };
  CHECK(history.before(0, memory).factor == 1);
  double t = 0, step = 0.03;
  for (int k = 0; k < 200; ++k, t += step, step = 0.03 + 0.02 * std::sin(k)) {
    REQUIRE(history.store(t, y(t), memory));
    REQUIRE(history.knows(memory));
    if (k < 3) continue;
    const double h = 0.02, at = t + h - 0.5;
    const ValueHistory::Past past = history.before(t + h, memory);
    CHECK(past.factor == 0);
    CHECK(past.constant == Approx(at < 0 ? y(0) : y(at)).epsilon(1e-10));
    const ValueHistory::Past within = history.before(t + 0.7, memory);  // a step longer than the delay
    CHECK(within.constant + within.factor * y(t + 0.7) == Approx(y(t + 0.2)).epsilon(1e-10));
    CHECK(within.factor > 0);
  }
}

TEST_CASE("the past of a value has a fixed size for any steps, and forgets what comes later") {
  const ValueHistory history(1, 50);
  VectorX memory = empty(history);
  double t = 0, worst = 0;
  for (int k = 0; k < 20000; ++k, t += k % 3 == 0 ? 1e-9 : 3e-4) {
    REQUIRE(history.store(t, std::sin(t), memory));
    REQUIRE(history.knows(memory));
    if (k % 100 == 0 && t > 1) worst = std::max(worst, std::abs(history.before(t, memory).constant - std::sin(t - 1)));
  }
  CHECK(worst > 0);
  CHECK(worst < 1e-5);  // (1/50)^3, times 1/12 and less
  REQUIRE(history.store(t - 0.5, 7, memory));
  CHECK(history.knows(memory));
  CHECK(history.before(t - 0.5 + 1, memory).constant == Approx(7).epsilon(1e-12));
}

TEST_CASE("the past of a value jumps where it has jumped, between smooth parts") {
  // A parabola until t = 0.5, another one after it, with steps of 0.1 that end there.
  const ValueHistory history(0.25, 50);
  VectorX memory = empty(history);
  const auto y = [](double t) { return t <= 0.5 ? 1 + t * t : 5 - t + 3 * t * t; };
  for (int k = 0; k <= 5; ++k) REQUIRE(history.store(0.1 * k, y(0.1 * k), memory));
  CHECK(std::isinf(history.next_jump(0.5, memory)));
  REQUIRE(history.store_after(0.5, 99, memory));
  REQUIRE(history.store_after(0.5, 5 - 0.5 + 3 * 0.25, memory));  // the latest value holds
  CHECK(history.next_jump(0.5, memory) == 0.75);
  CHECK(history.next_jump(0.74, memory) == 0.75);
  CHECK(std::isinf(history.next_jump(0.75, memory)));
  const auto past = [&](double now) {
    const ValueHistory::Past found = history.before(now, memory);
    return found.constant + found.factor * y(now);
  };
  // From the jump to the present there is a straight line, while no value is known after it.
  CHECK(past(0.76) == Approx(y(0.5 + 1e-12) + 0.01 / 0.26 * (y(0.76) - y(0.5 + 1e-12))));
  for (int k = 6; k <= 8; ++k) {
    REQUIRE(history.store(0.1 * k, y(0.1 * k), memory));
    REQUIRE(history.knows(memory));
    for (const double at : {0.41, 0.47, 0.4999, 0.5, 0.5001, 0.53, 0.61, 0.69, 0.75, 0.8}) {
      // From the jump to the only value after it there is a straight line.
      if (at + 0.25 < 0.1 * k || (k == 6 && at > 0.5)) continue;
      CAPTURE(k, at);
      CHECK(past(at + 0.25) == Approx(y(at)).epsilon(1e-10));
    }
  }
  memory[1] = 2;
  CHECK_FALSE(history.knows(memory));
}

TEST_CASE("a value that has not changed at a discontinuity has no jump, and parabolas do not pass over its kink") {
  const ValueHistory history(0.25, 50);
  VectorX memory = empty(history);
  const auto y = [](double t) { return t <= 0.5 ? 2 + t : 2.5 - 10 * (t - 0.5); };
  int checked = 0;
  for (int k = 0; k <= 9; ++k) {
    REQUIRE(history.store(0.1 * k, y(0.1 * k), memory));
    if (k == 5) REQUIRE(history.store_after(0.5, y(0.5) * (1 + 1e-13), memory));
    for (const double at : {0.43, 0.47, 0.52, 0.57, 0.66}) {
      const double now = at + 0.25;
      if (k < 4 || now < 0.1 * k || at > 0.1 * k) continue;
      CAPTURE(k, at);
      CHECK(history.before(now, memory).constant == Approx(y(at)).epsilon(1e-12));
      ++checked;
    }
  }
  CHECK(std::isinf(history.next_jump(0.5, memory)));
  CHECK(checked > 5);
}

TEST_CASE("a value that is set back before a jump forgets it") {
  const ValueHistory history(1, 10);
  VectorX memory = empty(history);
  REQUIRE(history.store(0, 1, memory));
  REQUIRE(history.store(0.5, 1, memory));
  REQUIRE(history.store_after(0.5, 2, memory));
  REQUIRE(history.store(0.7, 2, memory));
  CHECK(history.next_jump(0.7, memory) == 1.5);
  SECTION("to the time of the jump: it stays") {
    REQUIRE(history.store(0.5, 3, memory));
    CHECK(history.next_jump(0.5, memory) == 1.5);
    CHECK(history.before(1.5, memory).constant == 1);
  }
  SECTION("to an earlier time") {
    REQUIRE(history.store(0.4, 1, memory));
    CHECK(std::isinf(history.next_jump(0.4, memory)));
    CHECK(history.knows(memory));
  }
}

TEST_CASE("the past of a value has places for a third as many jumps as values, and refuses more") {
  const int points = 30;
  const ValueHistory history(1, points);
  VectorX memory = empty(history);
  int jumps = 0;
  double t = 0;
  const auto jump = [&] {  // two steps between jumps
    for (int k = 0; k < 2; ++k, t += 1e-3)
      if (!history.store(t, jumps, memory)) return false;
    t -= 1e-3;
    if (!history.store_after(t, jumps + 1, memory)) return false;
    t += 1e-3;
    return ++jumps < 1000;
  };
  while (jump()) REQUIRE(history.knows(memory));
  CHECK(jumps >= points / 3);
  CHECK(jumps < 2 * points);
  CHECK(history.next_jump(t, memory) == Approx(1 + 1e-3));  // the first is not lost
  // Jumps of an older past leave their places to new ones.
  const ValueHistory longer(0.02, points);
  memory = empty(longer);
  for (int k = 0; k < 1000; ++k) {
    REQUIRE(longer.store(0.003 * k, k, memory));
    REQUIRE(longer.store_after(0.003 * k, k + 1, memory));
  }
}
