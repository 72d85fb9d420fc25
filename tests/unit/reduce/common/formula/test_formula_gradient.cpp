// Compares value and gradient from one evaluation with the value and the derivatives along each argument, which
// test_expression.cpp tests.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/expression.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::ComputationError;
using bielle::Expression;
using bielle::test::message_of;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

// Both evaluations sum the same few products in different orders.
constexpr double rounding = 1e-14;

/// Returns the expected gradient, or the message if there is none.
std::string expected_message(const Expression& formula, const std::vector<double>& x) {
  return message_of<ComputationError>([&] {
    formula(x);
    for (std::size_t i = 0; i < x.size(); ++i) formula.derivative(x, i);
  });
}

void check_gradient(const Expression& formula, const std::vector<double>& x) {
  CAPTURE(formula.text(), x);
  std::vector<double> gradient(x.size(), std::numeric_limits<double>::quiet_NaN());
  const std::string wrong = expected_message(formula, x);
  if (wrong != "(nothing thrown)") {
    CHECK(message_of<ComputationError>([&] { formula.value_and_gradient(x, gradient); }) == wrong);
    return;
  }
  CHECK(formula.value_and_gradient(x, gradient) == formula(x));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double expected = formula.derivative(x, i);
    CHECK_THAT(gradient[i], WithinAbs(expected, rounding * std::max(1.0, std::abs(expected))));
  }
}

const std::vector<double> borders{-3, -2, -1.5, -1, -0.5, 0, 0.25, 0.5, 1, 1.5, 2, 3};

/// The arguments are all pairs of a few values at which most formulas have kinks or ends, and some ordinary values.
void check_gradient_everywhere(const std::string& text, const std::string& folder = ".") {
  const Expression formula(text, {"x", "y", "z"}, {{"r", 0.7}}, folder);
  for (const double x : borders)
    for (const double y : borders) check_gradient(formula, {x, y, 0.3});
  for (const double x : {0.123, 0.77, 1.234})
    for (const double y : {-0.91, 0.31, 2.718}) check_gradient(formula, {x, y, -1.1});
}

}  // namespace

TEST_CASE("The gradient consists of the derivatives along each argument, for every operation") {
  for (const std::string text : {"3",
                                 "r",
                                 "x",
                                 "y",
                                 "-x",
                                 "!x",
                                 "x + y",
                                 "x - y*z",
                                 "x*y",
                                 "x/y",
                                 "r/x",
                                 "x^3",
                                 "x^2",
                                 "x^1",
                                 "x^0",
                                 "x^-1",
                                 "x^1.5",
                                 "x^y",
                                 "2^y",
                                 "pow(x, 2*y)",
                                 "sin(x*y)",
                                 "cos(x + y)",
                                 "tan(x)",
                                 "asin(x)",
                                 "acos(x*y)",
                                 "atan(x/3)",
                                 "atan2(x, y)",
                                 "atan2(y, 1)",
                                 "atan2(1, x)",
                                 "sinh(x)",
                                 "cosh(x*z)",
                                 "tanh(x)",
                                 "asinh(y)",
                                 "acosh(x)",
                                 "atanh(x*y)",
                                 "exp(x - y)",
                                 "ln(x)",
                                 "log2(x)",
                                 "log10(x*y)",
                                 "sqrt(x)",
                                 "sqrt(x^2 + y^2)",
                                 "abs(x)",
                                 "sign(y)",
                                 "floor(x)",
                                 "ceil(y)",
                                 "round(x)",
                                 "mod(x, 1)",
                                 "mod(x, y)",
                                 "min(x, y)",
                                 "max(x, y, z)",
                                 "sum(x, y, z)",
                                 "avg(x, y)",
                                 "x < y",
                                 "x <= 1",
                                 "x > 1",
                                 "x >= y",
                                 "x == y",
                                 "x != 0",
                                 "x && y",
                                 "x || 1/y > 2",
                                 "if(x > y, x*y, x/y)",
                                 "if(y, x, 2*x)",
                                 "step(x, 0, 1)",
                                 "step(x, y, 2)",
                                 "ramp(x, -1, 2)",
                                 "ramp(z, x, y)",
                                 "pulse(x, 0, 1)",
                                 "pulse(x, y, 3)"})
    check_gradient_everywhere(text);
}

TEST_CASE("At kinks the gradient is the right-hand one along each argument") {
  for (const std::string text : {"abs(x)*y",
                                 "abs(x - y)",
                                 "abs(x^2 - y^2)",
                                 "max(0, x)*y",
                                 "max(x, x)",
                                 "min(x*y, y)",
                                 "x*floor(x)",
                                 "x*floor(-y)",
                                 "y*sign(x)",
                                 "x*(y > 0)",
                                 "if(x > 0, x^2, -y)",
                                 "if(x*y, x, y)",
                                 "x*(abs(y) == 0)",
                                 "x*pulse(y, 0, 1)",
                                 "y*step(x, 0, 1)",
                                 "ramp(x, 0, 1)^2*y",
                                 "abs(x)*abs(y)",
                                 "abs(min(x, y)) + max(x, z)",
                                 "x^(y^2)",
                                 "if(x < 1, sqrt(y), 1/y)",
                                 "x*floor(y^2)",
                                 "mod(x*y, 0.5)"})
    check_gradient_everywhere(text);
  const Expression formula("abs(x) - 2*abs(y)", {"x", "y"});
  std::vector<double> gradient(2);
  CHECK(formula.value_and_gradient(std::vector<double>{0, 0}, gradient) == 0);
  CHECK(gradient == std::vector<double>{1, -2});
}

TEST_CASE("The gradient of tables and splines is right, also at their points") {
  const bielle::test::TemporaryFolder folder;
  folder.file("curve.csv", "-20, 1\n-1, 2\n0, 0\n1, 2\n3, 0\n20, 1\n");
  for (const std::string text : {"table('curve.csv', x)", "y*table('curve.csv', -x)", "table('curve.csv', x*y)",
                                 "spline('curve.csv', x)", "spline('curve.csv', x - y)*z", "table('curve.csv', 9*x)"})
    check_gradient_everywhere(text, folder.path());
}

TEST_CASE("If there is no finite derivative, the gradient fails with the same message") {
  const Expression root("y*sqrt(x)", {"x", "y"}), hidden("cos(sqrt(x)) + y", {"x", "y"});
  std::vector<double> gradient(2);
  CHECK(message_of<ComputationError>([&] {
          root.value_and_gradient(std::vector<double>{0, 1}, gradient);
        }) == "formula 'y*sqrt(x)' at x = 0, y = 1: there is no finite first derivative");
  CHECK(message_of<ComputationError>([&] {
          root.value_and_gradient(std::vector<double>{-1, 1}, gradient);
        }) == "formula 'y*sqrt(x)' at x = -1, y = 1: the value is not a finite number");
  check_gradient(hidden, {0, 1});
}

TEST_CASE("The gradient of a formula of many variables is computed in several passes") {
  for (const std::size_t count : {15U, 16U, 17U, 40U}) {
    std::vector<std::string> names;
    std::vector<double> x;
    std::string text = "abs(x0)";
    for (std::size_t i = 0; i < count; ++i) {
      names.push_back(fmt::format("x{}", i));
      x.push_back(0.1 * static_cast<double>(i));  // the first argument is at a kink
      text += fmt::format(" + x{}^2*x{}", i, count - 1 - i);
    }
    check_gradient(Expression(text, names), x);
  }
  std::vector<double> none;
  CHECK(Expression("2*3", {}).value_and_gradient(none, none) == 6);
}

TEST_CASE("A formula tells which variables it uses") {
  const Expression formula("if(r > 1, q, 2*v) + 0*t", {"t", "q", "v", "s"}, {{"r", 0}});
  CHECK(formula.uses(0));
  CHECK_FALSE(formula.uses(1));
  CHECK(formula.uses(2));
  CHECK_FALSE(formula.uses(3));
  CHECK_FALSE(formula.is_constant());
  const Expression constant("if(1 > 2, t, 3)", {"t"});
  CHECK_FALSE(constant.uses(0));
  CHECK(constant.is_constant());
}
