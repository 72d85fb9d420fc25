#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/formula/units.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::Expression;
using bielle::units_of;

namespace {

/// Returns the units of a formula of quantities with units of their own and of a parameter `r`.
std::string units(const std::string& text, const std::string& folder = ".") {
  const Expression formula(text, {"x", "y", "angle", "rate", "force", "moment", "v", "t", "n", "what"}, {{"r", 0.5}},
                           folder);
  return units_of(formula, {"m", "m", "rad", "rad/s", "N", "N m", "m/s", "s", "-", ""});
}
/// Returns units that were read and written again.
std::string read(const std::string& text) { return units_of(Expression("a", {"a"}), {text}); }

}  // namespace

TEST_CASE("Units are written as they were read") {
  for (const std::string text :
       {"m", "-", "N m", "rad/s", "N m/rad", "m^2/s^2", "1/s", "N/(m s)", "Pa", "kg m^2", "1/(m s^2)", ""})
    CHECK(read(text) == text);
  CHECK(read("m N") == "N m");
  CHECK(read("m m") == "m^2");
  CHECK(read("m/m") == "-");
  for (const std::string text : {"N/m s", "N/m/s", "1", "m^x", "m^-1", "m^", "/s", "m/", "N m)", "2 m", "m^0", " "})
    CHECK(read(text).empty());
}

TEST_CASE("Sums and choices keep the units of their terms") {
  CHECK(units("x") == "m");
  CHECK(units("-x + y - 2") == "m");
  CHECK(units("r - x") == "m");
  CHECK(units("abs(x - y)") == "m");
  CHECK(units("min(x, 1, y)") == "m");
  CHECK(units("max(x, 0)") == "m");
  CHECK(units("avg(x, y)") == "m");
  CHECK(units("mod(angle, 2*pi)") == "rad");
  CHECK(units("round(x)") == "m");
  CHECK(units("if(angle > 1, x, -y)") == "m");
  CHECK(units("if(angle > 1, x, 0)") == "m");
  CHECK(units("x + angle").empty());
  CHECK(units("x + n").empty());
  CHECK(units("max(x, angle)").empty());
  CHECK(units("if(x > 1, x, angle)").empty());
  CHECK(units("x + what").empty());
}

TEST_CASE("Products and quotients combine units; constants have none") {
  CHECK(units("force*v") == "N m/s");
  CHECK(units("x/t") == "m/s");
  CHECK(units("x/y") == "-");
  CHECK(units("moment/angle") == "N m/rad");
  CHECK(units("moment*rate") == "N m rad/s");
  CHECK(units("force/x/t") == "N/(m s)");
  CHECK(units("1/t") == "1/s");
  CHECK(units("1000*x") == "m");
  CHECK(units("x*r/2") == "m");
  CHECK(units("if(t > 1, r, 3)*x") == "m");
  CHECK(units("n*x") == "m");
  CHECK(units("x/t - v") == "m/s");
  CHECK(units("x*what").empty());
  CHECK(units("3*r").empty());
  CHECK(units("if(t > 1, 2, 3)").empty());
}

TEST_CASE("Powers multiply exponents, which remain whole numbers") {
  CHECK(units("x^2") == "m^2");
  CHECK(units("v^2") == "m^2/s^2");
  CHECK(units("t^-1") == "1/s");
  CHECK(units("pow(x, 2)*force") == "N m^2");
  CHECK(units("x^0") == "-");
  CHECK(units("sqrt(x^2 + y^2)") == "m");
  CHECK(units("(x*y)^0.5") == "m");
  CHECK(units("(x*y)^1.5") == "m^3");
  CHECK(units("if(t > 0, t^(1 - 2), 0)") == "1/s");
  CHECK(units("sqrt(x/y)") == "-");
  CHECK(units("sqrt(x)").empty());
  CHECK(units("x^1.5").empty());
  CHECK(units("x^n").empty());
  CHECK(units("x^1e9").empty());
  CHECK(units("if(t > 0, x^(1/0), x)").empty());
}

TEST_CASE("Functions and comparisons are dimensionless") {
  for (const std::string text : {"sin(angle)", "atan2(y, x)", "exp(-t)", "ln(x)", "sign(x)", "x > 1", "x == y", "!x",
                                 "x && y", "step(t, 0, 1)", "ramp(t, 0, 1)", "pulse(t, 0, 1)"})
    CHECK(units(text) == "-");
  CHECK(units("x*step(t, 0, 1)") == "m");
  CHECK(units("(x > 1)*force") == "N");
}

TEST_CASE("The units of tables, and of variables without units, are unknown") {
  const bielle::test::TemporaryFolder folder;
  folder.file("c.csv", "0 1\n1 2\n");
  CHECK(units("table('c.csv', x)", folder.path()).empty());
  CHECK(units("what").empty());
  CHECK(units_of(Expression("a + b", {"a", "b"}), {"m"}).empty());
  CHECK(units_of(Expression(2.0), {}).empty());
}
