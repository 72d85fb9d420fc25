// Tests of numbers with units: their parts, their values in SI units, and the messages about units that do not fit.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/input/unit.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using bielle::test::message_of;

namespace test_unit {
namespace {

const double turn = 2 * std::acos(-1.0);

double si(const std::string& text, const std::string& units) {
  const auto quantity = quantity_of(text);
  REQUIRE(quantity);
  return to_si(*quantity, units);
}

std::string refusal(const std::string& text, const std::string& units) {
  return message_of<InputError>([&] { si(text, units); });
}

}  // namespace

TEST_CASE("Quantities are converted to the SI unit that is expected") {
  CHECK(si("210 GPa", "Pa") == Approx(210e9));
  CHECK(si("80 bar", "Pa") == Approx(8e6));
  CHECK(si("12 mm", "m") == Approx(0.012));
  CHECK(si("2 in", "m") == Approx(0.0508));
  CHECK(si("5 deg", "rad") == Approx(5 * turn / 360));
  CHECK(si("5 \u00b0", "rad") == Approx(5 * turn / 360));
  CHECK(si("3000 rpm", "rad/s") == Approx(50 * turn));
  CHECK(si("2 rev", "rad") == Approx(2 * turn));
  CHECK(si("90 deg/s", "rad/s") == Approx(turn / 4));
  CHECK(si("60 L/min", "m^3/s") == Approx(1e-3));
  CHECK(si("3 N mm/deg", "N m/rad") == Approx(3e-3 * 360 / turn));
  CHECK(si("5 kg mm^2", "kg m^2") == Approx(5e-6));
  CHECK(si("7.85 g/cm^3", "kg/m^3") == Approx(7850));
  CHECK(si("50 Hz", "1/s") == Approx(50));
  CHECK(si("2 1/s", "Hz") == Approx(2));
  CHECK(si("5 Nm", "N m") == Approx(5));
  CHECK(si("1 kWh", "J") == Approx(3.6e6));
}

TEST_CASE("Temperature scales have different zeros") {
  CHECK(si("20 degC", "K") == Approx(293.15));
  CHECK(si("-40 degF", "K") == Approx(233.15));
  CHECK(si("20 degC", "any") == Approx(293.15));
}

TEST_CASE("360 degrees are 2 pi to the last digit") { CHECK(si("360 deg", "rad") == turn); }

TEST_CASE("An angle is a dimension") {
  CHECK(refusal("50 Hz", "rad/s") == "expected a value in rad/s, found one in 'Hz', which measures something else");
  CHECK(refusal("3000 rpm", "Hz") == "expected a value in Hz, found one in 'rpm', which measures something else");
  CHECK(refusal("3000 rpm", "1/s") == "expected a value in 1/s, found one in 'rpm', which measures something else");
  CHECK(refusal("5 N m", "N m/rad") ==
        "expected a value in N m/rad, found one in 'N m', which measures something else");
  CHECK(refusal("5 deg", "m") == "expected a value in m, found one in 'deg', which measures something else");
}

TEST_CASE("A unit does not stand for its reciprocal") {
  CHECK(refusal("50 Hz", "s") == "expected a value in s, found one in 'Hz', which measures something else");
  CHECK(refusal("20 ms", "Hz") == "expected a value in Hz, found one in 'ms', which measures something else");
  CHECK(refusal("5 1/m", "m") == "expected a value in m, found one in '1/m', which measures something else");
  CHECK(refusal("5 1/deg", "rad") == "expected a value in rad, found one in '1/deg', which measures something else");
}

TEST_CASE("If several units are expected, the one that fits is used") {
  CHECK(si("3 mm", "m or rad") == Approx(3e-3));
  CHECK(si("3 deg", "m or rad") == Approx(3 * turn / 360));
  CHECK(si("3 deg/s^2", "m/s^2 or rad/s^2") == Approx(3 * turn / 360));
  CHECK(refusal("3 kg", "m or rad") ==
        "expected a value in m or rad, found one in 'kg', which measures something else");
}

TEST_CASE("A unit that is not expected, or unknown, is refused") {
  CHECK(refusal("5 mm", "") == "expected a number without a unit, found the unit 'mm'");
  CHECK(refusal("5 %", "") == "expected a number without a unit, found the unit '%'");
  CHECK(refusal("5 furlongz", "m") == "'furlongz' is no unit; expected one of m");
  CHECK(refusal("5 furlongz", "any") == "'furlongz' is no unit");
  CHECK(refusal("3 mm", "m^2") == "expected a value in m^2, found one in 'mm', which measures something else");
}

TEST_CASE("If any unit is allowed, values are in the base units of the SI") {
  CHECK(si("5 mm", "any") == Approx(5e-3));
  CHECK(si("3 kN", "any") == Approx(3000));
  CHECK(si("30 min", "any") == Approx(1800));
  CHECK(si("5 deg", "any") == Approx(5 * turn / 360));
  CHECK(si("60 rpm", "any") == Approx(turn));
  CHECK(si("2 kHz", "any") == Approx(2000));
  CHECK(si("3 N mm/deg", "any") == Approx(3e-3 * 360 / turn));
  CHECK(si("5 %", "any") == Approx(0.05));
  CHECK(si("7 kg", "any") == Approx(7));
}

TEST_CASE("A quantity is a number, a blank and a unit") {
  const auto parts = [](const std::string& text) {
    const auto quantity = quantity_of(text);
    REQUIRE(quantity);
    return *quantity;
  };
  CHECK(parts("-1.5e3  mm ").value == -1500);
  CHECK(parts("-1.5e3  mm ").unit == "mm");
  CHECK(parts("+5 N mm/deg").value == 5);
  CHECK(parts("+5 N mm/deg").unit == "N mm/deg");
  CHECK(parts("5 1/s").unit == "1/s");
  CHECK(parts("5 %").unit == "%");
}

TEST_CASE("Formulas and plain numbers are no quantities") {
  for (const char* text :
       {"2 * x", "3 - x", "2*t", "2 *x", "3 + 1", "2 ^ 2",  "3 < 4",  "2 ? 1 : 0", "2 / x",  "5",     "5 ",
        "x",     "5mm",   "mm",  "",     " 5 mm", "inf mm", "nan mm", "1e400 mm",  "5 == 3", "5 && 3"}) {
    CAPTURE(text);
    CHECK_FALSE(quantity_of(text));
  }
}

}  // namespace test_unit
