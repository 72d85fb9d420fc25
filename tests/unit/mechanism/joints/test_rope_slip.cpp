// The slip of a rope on a pulley from step to step. (Its balance of tensions: tests/benchmarks/joints.)
#include <catch2/catch.hpp>

#include "mechanism/joints/cables/rope_slip.hpp"

using namespace bielle::mechanism;

namespace test_rope_slip {
namespace {

/// The slip on an undamped rope of 2 m, which begins at zero at t = 0.
class Slipping {
 public:
  Slipping() {
    Declaration declaration;
    slip_.declare(declaration);
    slots_.first_orders = static_cast<int>(declaration.first_order.size());
    slots_.memories = static_cast<int>(declaration.memory.size());
    state_.first_order.setZero(slots_.first_orders);
    state_.memory = Eigen::Map<const VectorX>(declaration.memory.data(), slots_.memories);
    accept(0, 0);
  }
  void set(double time, double slip) {
    state_.time = time;
    state_.first_order[0] = slip;
  }
  void accept(double time, double slip) {
    set(time, slip);
    VectorX memory = state_.memory;
    slip_.accept(now(), memory);
    state_.memory = memory;
  }
  LocalState now() const { return {state_, slots_, environment_}; }
  RopeSlip::Value rate() const { return RopeSlip::rate(now()); }
  RopeSlip::Value rate(double time, double slip) {
    set(time, slip);
    return rate();
  }

 private:
  RopeSlip slip_{"cable", "rope", "pulley", 2, 0};
  State state_;
  Slots slots_;
  Environment environment_;
};

/// Two steps of 0.1 and 0.2 s along s = t/4 + t^2/2.
void take_two_steps(Slipping& slipping) {
  slipping.accept(0.1, 0.03);
  slipping.accept(0.3, 0.12);
}

}  // namespace

TEST_CASE("the rate of slip is that of a parabola through the last two steps, and stays until the next step") {
  Slipping slipping;
  CHECK(slipping.rate(0.1, 0.03).value == Approx(0.3));
  CHECK(slipping.rate().by_change == Approx(10));
  slipping.accept(0.1, 0.03);
  const RopeSlip::Value rate = slipping.rate(0.3, 0.12);
  CHECK(rate.value == Approx(0.25 + 0.3));  // ds/dt
  CHECK(rate.by_change == Approx((slipping.rate(0.3, 0.13).value - rate.value) / 0.01));
  CHECK(rate.by_change == Approx(rate.most));
  slipping.accept(0.3, 0.12);
  // The beginning of a branch is slightly later than the end of the step before it.
  for (const double later : {0.0, 1e-7}) {
    CHECK(slipping.rate(0.3 + later, 0.12).value == Approx(0.55));
    CHECK(slipping.rate().by_change == 0);
    CHECK(RopeSlip::per_time(slipping.now()) == 0);
  }
}

TEST_CASE("a rope that slips less than before does not slip back, and one that slips back has its mean rate") {
  Slipping slipping;
  take_two_steps(slipping);
  // The mean rates are 0.05 and 0.45 m/s in steps of 0.1 and 0.2 s: the parabola has a rate of -0.083 m/s.
  CHECK(slipping.rate(0.4, 0.125).value == 0);
  CHECK(slipping.rate().by_change == 0);
  CHECK(slipping.rate(0.4, 0.11).value == Approx(-0.1));
  CHECK(slipping.rate().by_change == Approx(10));
}

TEST_CASE("a change of slip within the error of Newton's method is none") {
  Slipping slipping;
  take_two_steps(slipping);
  slipping.accept(0.4, 0.12 + 1e-10);
  CHECK(RopeSlip::increment(slipping.now()) == Approx(1e-10));
  CHECK(slipping.rate().value == 0);
  CHECK(RopeSlip::last_change(slipping.now()) == 0);
  slipping.accept(0.5, 0.12 + 4e-10);
  CHECK(RopeSlip::increment(slipping.now()) == 0);
  CHECK(RopeSlip::last_change(slipping.now()) == Approx(4e-10));
}

TEST_CASE("a very short step without slip leaves the rate as it was") {
  Slipping slipping;
  take_two_steps(slipping);
  slipping.accept(0.3001, 0.12);
  CHECK(slipping.rate().value == Approx(0.55));
  CHECK(RopeSlip::last_change(slipping.now()) == Approx(0.09));
  slipping.accept(0.4001, 0.12);
  CHECK(slipping.rate().value == 0);
  CHECK(RopeSlip::last_change(slipping.now()) == 0);
}

}  // namespace test_rope_slip
