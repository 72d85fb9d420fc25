// Stops at the ends of a range: forces of both sides, energies, and the side just after a discontinuity.
#include <catch2/catch.hpp>

#include "mechanism/laws/stop_law.hpp"

using namespace bielle::mechanism;

namespace {

constexpr StopLaw stops{-1, 1, 1000, 50};

}  // namespace

TEST_CASE("both stops push back by spring and damper, and do not pull") {
  for (const double side : {1.0, -1.0}) {
    CHECK(stops.contact(side, side * 1.01, side * 0.2).N == Approx(side * (10 + 10)));
    CHECK(stops.contact(side, side * 1.01, side * -0.1).N == Approx(side * (10 - 5)));
    CHECK(stops.contact(side, side * 1.01, side * -1).N == 0);
    CHECK_FALSE(stops.contact(side, side * 1.01, side * -1).pushes);
    CHECK(stops.contact(side, side * 1.01, 0).penetration == Approx(0.01));
  }
  CHECK(stops.contact(0, 5, 1).N == 0);
}

TEST_CASE("the power of a stop is the rate of its energy and its dissipation, also if it does not push") {
  for (const double side : {1.0, -1.0})
    for (const double rate : {0.2, -0.1, -1.0}) {
      const StopLaw::Contact contact = stops.contact(side, side * 1.01, side * rate);
      Energy energy;
      stops.add_energy(contact, side * rate, energy);
      CHECK(energy.elastic == Approx(0.5 * 1000 * 0.01 * 0.01));
      CHECK(contact.N * side * rate == Approx(1000 * 0.01 * rate + energy.dissipation).margin(1e-12));
      CHECK(energy.dissipation >= 0);
    }
}

TEST_CASE("just after a discontinuity a part exactly at a stop touches it unless it moves away") {
  for (const double side : {1.0, -1.0}) {
    CHECK(stops.side_after(side, 0) == side);
    CHECK(stops.side_after(side, side * 1e-3) == side);
    CHECK(stops.side_after(side, side * -1e-3) == 0);
    CHECK(stops.side_after(side * 1.001, side * -1e-3) == side);
    CHECK(stops.side_after(side * 0.999, side * 1e-3) == 0);
  }
}
