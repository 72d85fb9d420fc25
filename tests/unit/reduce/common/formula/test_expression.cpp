#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/expression.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::ComputationError;
using bielle::Expression;
using bielle::InputError;
using bielle::Parameters;
using bielle::test::message_of;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using std::numbers::pi;

namespace test_expression {
namespace {

// A formula of a few operations has an error of a few roundings.
constexpr double rounding = 1e-15;

double constant(const std::string& text, const Parameters& parameters = {}) {
  return Expression(text, {}, parameters)(std::span<const double>());
}
Expression of_t(const std::string& text, const Parameters& parameters = {}) { return {text, {"t"}, parameters}; }
std::string why_wrong(const std::string& text, const Parameters& parameters = {}) {
  return message_of<InputError>([&] { of_t(text, parameters); });
}

}  // namespace

TEST_CASE("Formulas follow the usual precedence") {
  CHECK(constant("1+2*3^2") == 19);
  CHECK(constant("-2^2") == -4);
  CHECK(constant("2^-1") == 0.5);
  CHECK(constant("2^3^2") == 512);
  CHECK(constant("10-3-4") == 3);
  CHECK(constant("16/4/2") == 2);
  CHECK(constant("2*-3") == -6);
  CHECK(constant("+3-+2") == 1);
  CHECK(constant("1+1 > 1 && 2 < 1+2") == 1);
  CHECK(constant("1 == 2 || 3 != 4") == 1);
  CHECK(constant("!0 + !5") == 1);
  CHECK(constant("1e3 + 210e9 + .5 + 2.") == 210000001002.5);
  CHECK(constant("2*pi*50") == 2 * pi * 50);
}

TEST_CASE("Every function has its value") {
  CHECK(constant("sin(0.3)") == std::sin(0.3));
  CHECK(constant("cos(0.3)") == std::cos(0.3));
  CHECK(constant("tan(0.3)") == std::tan(0.3));
  CHECK(constant("asin(0.3)") == std::asin(0.3));
  CHECK(constant("acos(0.3)") == std::acos(0.3));
  CHECK(constant("atan(0.3)") == std::atan(0.3));
  CHECK(constant("atan2(-1, -1)") == -3 * pi / 4);
  CHECK(constant("sinh(0.3)") == std::sinh(0.3));
  CHECK(constant("cosh(0.3)") == std::cosh(0.3));
  CHECK(constant("tanh(0.3)") == std::tanh(0.3));
  CHECK(constant("asinh(0.3)") == std::asinh(0.3));
  CHECK(constant("acosh(1.3)") == std::acosh(1.3));
  CHECK_THAT(constant("atanh(0.3)"), WithinRel(std::atanh(0.3), rounding));
  CHECK(constant("exp(1)") == std::numbers::e);
  CHECK(constant("ln(exp(2))") == 2);
  CHECK(constant("log10(1000)") == 3);
  CHECK(constant("log2(8)") == 3);
  CHECK(constant("sqrt(16)") == 4);
  CHECK(constant("abs(-3)") == 3);
  CHECK(constant("sign(-3) + sign(0)") == -1);
  CHECK(constant("floor(-1.5)") == -2);
  CHECK(constant("ceil(-1.5)") == -1);
  CHECK(constant("round(2.5)") == 3);
  CHECK(constant("pow(2, 10)") == 1024);
  CHECK(constant("mod(7, 3)") == 1);
  CHECK(constant("mod(-1, 3)") == 2);  // the remainder has the sign of the divisor, as phases need it
  CHECK(constant("min(3, 1, 2)") == 1);
  CHECK(constant("max(3, 1, 2)") == 3);
  CHECK(constant("max(3)") == 3);
  CHECK(constant("sum(1, 2, 3)") == 6);
  CHECK(constant("avg(1, 2, 6)") == 3);
  CHECK(constant("if(2 > 1, 10, 20)") == 10);
  CHECK(constant("if(2 < 1, 10, 20)") == 20);
}

TEST_CASE("Step, ramp and pulse have their values and ends as documented") {
  const Expression step = of_t("step(t, 1, 3)"), ramp = of_t("ramp(t, 1, 3)"), pulse = of_t("pulse(t, 1, 3)");
  CHECK(step(0.0) == 0);
  CHECK(step(1.0) == 0);
  CHECK(step(2.0) == 0.5);
  CHECK_THAT(step(1.5), WithinAbs(10 / 64.0 - 15 / 256.0 + 6 / 1024.0, rounding));  // 10 s^3 - 15 s^4 + 6 s^5, s = 1/4
  CHECK(step(3.0) == 1);
  CHECK(step(9.0) == 1);
  CHECK(ramp(1.5) == 0.25);
  CHECK(ramp(0.5) == 0);
  CHECK(ramp(3.5) == 1);
  CHECK(pulse(0.999) == 0);
  CHECK(pulse(1.0) == 1);
  CHECK(pulse(2.999) == 1);
  CHECK(pulse(3.0) == 0);
}

TEST_CASE("Parameters and variables may be used by name") {
  const Expression formula("r*speed*t + q", {"t", "q"}, {{"r", 0.5}, {"speed", 4}});
  CHECK(formula(std::vector<double>{3, 1}) == 7);
  CHECK_FALSE(formula.is_constant());
  CHECK(of_t("2*r", {{"r", 3}}).is_constant());
  CHECK(formula.text() == "r*speed*t + q");
  CHECK(Expression()(std::span<const double>()) == 0);
  CHECK(Expression(2.5)(1.0) == 2.5);
  CHECK(Expression(2.5).is_constant());
  CHECK(Expression(2.5).derivative(1.0) == 0);
}

TEST_CASE("Formulas that muParser would silently misread are refused") {
  CHECK_THAT(why_wrong("1,2"), Contains("expected one value"));
  CHECK_THAT(why_wrong("0,5*t"), Contains("a decimal point is written '.'"));
  CHECK_THAT(why_wrong("1/0"), Contains("division by zero"));
  CHECK_THAT(why_wrong("t/(1-1)"), Contains("division by zero"));
  CHECK_THAT(why_wrong("0^-1"), Contains("division by zero"));
  CHECK_THAT(why_wrong("mod(t, 0)"), Contains("division by zero"));
  CHECK_THAT(why_wrong("sqrt(-1)*t"), Contains("not a finite number"));
  CHECK_THAT(why_wrong("ln(0)"), Contains("not a finite number"));
  CHECK_THAT(why_wrong("exp(1000)"), Contains("not a finite number"));
  CHECK_THAT(why_wrong("1e999"), Contains("too large"));
  CHECK_THAT(why_wrong("t=3"), Contains("write =="));
  CHECK_THAT(why_wrong("t > 1 ? 2 : 3"), Contains("if(condition, a, b)"));
  CHECK_THAT(why_wrong("log(t)"), Contains("write ln or log10"));
  CHECK_THAT(why_wrong("inf"), Contains("unknown name 'inf'"));
  CHECK_THAT(why_wrong("nan"), Contains("unknown name 'nan'"));
}

TEST_CASE("The message about a wrong formula tells the place and the nearest name") {
  CHECK_THAT(why_wrong("2*spede*t", {{"speed", 1}}),
             Contains("unknown name 'spede' at character 3; did you mean 'speed'?"));
  CHECK_THAT(why_wrong("2*omega*t", {{"length", 1}, {"mass", 1}}),
             Contains("unknown name 'omega' at character 3; expected one of 'length', 'mass', 't'; pi; or a function"));
  CHECK_THAT(why_wrong("2*sqr(t)"), Contains("unknown name 'sqr' at character 3; did you mean 'sqrt'?"));
  CHECK_THAT(why_wrong("2*spede*t", {{"speed", 1}}), Contains("in '2*spede*t': "));
  CHECK_THAT(why_wrong(""), Contains("the formula is empty"));
  CHECK_THAT(why_wrong("   "), Contains("the formula is empty"));
  CHECK_THAT(why_wrong("2 t"), Contains("an operator is missing"));
  CHECK_THAT(why_wrong("t = 2"), Contains("to compare, write =="));
  CHECK_THAT(why_wrong("2pi"), Contains("an operator is missing"));
  CHECK_THAT(why_wrong("3..4"), Contains("an operator is missing"));
  CHECK_THAT(why_wrong("1_000"), Contains("unknown name '_000' at character 2"));
  CHECK_THAT(why_wrong("sin(t"), Contains("')' is missing"));
  CHECK_THAT(why_wrong("t)"), Contains("unexpected ')'"));
  CHECK_THAT(why_wrong("t+"), Contains("breaks off"));
  CHECK_THAT(why_wrong("sin"), Contains("must be followed by '('"));
  CHECK_THAT(why_wrong("sin()"), Contains("too few arguments of 'sin'"));
  CHECK_THAT(why_wrong("sin(1, 2)"), Contains("too many arguments of 'sin'"));
  CHECK_THAT(why_wrong("step(t, 1)"), Contains("too few arguments of 'step'"));
  CHECK_THAT(why_wrong("t#3"), Contains("not understood"));
  CHECK_THAT(why_wrong("(1,2)+t"), Contains("unexpected ','"));
  CHECK_THAT(why_wrong("table(t, t)"), Contains("quoted file name"));
  CHECK_THAT(why_wrong("sin('f.csv')"), Contains("quoted file name"));
  CHECK_THAT(why_wrong("step(t, 2, 1)"), Contains("must end after its start, but runs from 2 to 1"));
  CHECK_THAT(why_wrong("t*sin", {{"sin", 1}}), Contains("built in"));
  CHECK_THAT(why_wrong("t", {{"t", 1}}), Contains("both a parameter and a variable"));
  CHECK(of_t("2*t", {{"q", 1}, {"v", 2}})(3.0) == 6);
}

TEST_CASE("A branch that is not taken may have no finite value") {
  const Parameters gap{{"gap", 0}};
  CHECK(constant("if(gap > 0, 1/gap, 7)", gap) == 7);
  CHECK(of_t("if(gap > 0, t/gap, t)", gap)(2.0) == 2);
  CHECK(of_t("if(t > 0, 1/t, 0)")(0.0) == 0);
  CHECK(of_t("t > 0 && 1/t > 2")(0.0) == 0);
  CHECK(of_t("t == 0 || 1/t > 2")(0.0) == 1);
}

TEST_CASE("A value that is not finite is an error that names formula and arguments") {
  const Expression formula("1/(t-1) + q", {"t", "q"});
  const std::string message = message_of<ComputationError>([&] { formula(std::vector<double>{1, 2}); });
  CHECK(message == "formula '1/(t-1) + q' at t = 1, q = 2: division by zero");
  CHECK_THROWS_AS(of_t("sqrt(t)")(-1.0), ComputationError);
  CHECK_THROWS_AS(of_t("1/(1/t)")(0.0), ComputationError);       // muParser returns 0
  CHECK_THROWS_AS(of_t("sqrt(t) > 0")(-1.0), ComputationError);  // muParser returns 0
  CHECK_THROWS_AS(of_t("step(t, 1, t)")(0.5), ComputationError);
}

TEST_CASE("Derivatives are as accurate as the value") {
  // The derivatives are compared with closed forms at an argument where differences would lose all digits: the rounding
  // of the argument 100 t alone causes |100 t| eps = 1e-11 of the scale.
  const double t = 1e3, w = 100, phase_rounding = 2e-11;
  const Expression formula = of_t("sin(100*t)");
  CHECK_THAT(formula.derivative(t, 1), WithinAbs(w * std::cos(w * t), w * phase_rounding));
  CHECK_THAT(formula.derivative(t, 2), WithinAbs(-w * w * std::sin(w * t), w * w * phase_rounding));
  CHECK(of_t("3").derivative(t, 1) == 0);
  CHECK(of_t("3").derivative(t, 2) == 0);
  CHECK(of_t("2 - 4*t").derivative(t, 1) == -4);
  CHECK(of_t("2 - 4*t").derivative(t, 2) == 0);
  CHECK(of_t("t^2").derivative(0.0, 2) == 2);
  CHECK(of_t("t^3").derivative(0.0, 2) == 0);
  CHECK(of_t("t^1.5").derivative(0.0, 1) == 0);
}

TEST_CASE("The derivatives of every function agree with those of its series") {
  // Central differences of eighth order of f and of f': truncation h^8 f^(9) / 630, where f^(9) <= 11! / 0.7^12 = 3e9
  // (of -2/t^3), gives 2e-12; rounding gives eps |f| / h = 4e-14 |f|. Bound with a margin: 1e-10.
  // clang-format off
  const std::vector<std::string> formulas = {
      "sin(t)", "cos(t)", "tan(t)", "asin(t/2)", "acos(t/2)", "atan(t)", "sinh(t)", "cosh(t)", "tanh(t)", "asinh(t)",
      "acosh(1+t)", "atanh(t/2)", "exp(t)", "ln(t)", "log2(t)", "log10(t)", "sqrt(t)", "1/t", "t/(1+t^2)", "t^2.5",
      "2^t", "t^t", "t^-2", "pow(t, 3)", "atan2(t, 2-t)", "atan2(cos(t), t^2)", "step(t, 0.1, 2)", "ramp(t, 0.1, 2)",
      "ramp(t^2, 0.1, 2*t)", "step(sin(t), 0, 1.5)", "abs(-t)*t", "min(t, t^2)", "max(t, t^2)", "mod(t^2, 0.45)",
      "if(t > 0.2, t^3, 1)", "sum(t, t^2, t^3)", "avg(t, t^3)", "-t^2 + 3*t - 1", "sin(t)*exp(-t)/(1+cos(t))",
      "(t > 0.1)*t^2", "floor(t+9.1)*t", "ceil(t)*t^2", "round(t)*t^2", "sign(t)*t^2"};
  // clang-format on
  const double t = 0.7, h = 0.005;
  const auto difference = [&](auto&& f) {
    return (4 / 5.0 * (f(t + h) - f(t - h)) - 1 / 5.0 * (f(t + 2 * h) - f(t - 2 * h)) +
            4 / 105.0 * (f(t + 3 * h) - f(t - 3 * h)) - 1 / 280.0 * (f(t + 4 * h) - f(t - 4 * h))) /
           h;
  };
  for (const std::string& text : formulas) {
    INFO(text);
    const Expression f = of_t(text);
    CHECK_THAT(f.derivative(t, 1), WithinAbs(difference([&](double x) { return f(x); }), 1e-10));
    CHECK_THAT(f.derivative(t, 2), WithinAbs(difference([&](double x) { return f.derivative(x, 1); }), 1e-10));
  }
}

TEST_CASE("Partial derivatives hold the other arguments") {
  const Expression formula("x^2*y + sin(y)*z", {"x", "y", "z"});
  const std::vector<double> at = {2, 0.5, 3};
  CHECK(formula.derivative(at, 0) == 2);
  CHECK(formula.derivative(at, 0, 2) == 1);
  CHECK_THAT(formula.derivative(at, 1), WithinRel(4 + std::cos(0.5) * 3, rounding));
  CHECK_THAT(formula.derivative(at, 1, 2), WithinRel(-std::sin(0.5) * 3, rounding));
  CHECK(formula.derivative(at, 2) == std::sin(0.5));
}

TEST_CASE("At a kink the derivative is the one on the right") {
  CHECK(of_t("abs(t)").derivative(0.0) == 1);
  CHECK(of_t("abs(-3*t)").derivative(0.0) == 3);
  CHECK(of_t("max(t, 0)").derivative(0.0) == 1);
  CHECK(of_t("min(t, 0)").derivative(0.0) == 0);
  CHECK(of_t("if(t > 0.01, 5*t, 0)").derivative(0.01) == 5);
  CHECK(of_t("if(t < 0.01, 5*t, 2*t)").derivative(0.01) == 2);
  CHECK(of_t("if(-t >= -0.01, 5*t, 2*t)").derivative(0.01) == 2);
  CHECK(of_t("if(t, 5*t, 1)").derivative(0.0) == 5);
  CHECK(of_t("ramp(t, 1, 3)").derivative(1.0) == 0.5);
  CHECK(of_t("ramp(t, 1, 3)").derivative(3.0) == 0);
  CHECK(of_t("ramp(-t, -3, -1)").derivative(1.0) == -0.5);
  CHECK(of_t("t*floor(t)").derivative(1.0) == 1);
  CHECK(of_t("t*floor(-t)").derivative(1.0) == -2);
  CHECK(of_t("mod(t, 1)").derivative(1.0) == 1);
  CHECK(of_t("step(t, 1, 3)").derivative(1.0, 2) == 0);
  CHECK(of_t("abs(t^2)").derivative(0.0, 2) == 2);  // the second derivative gives the sign on the right
  CHECK(of_t("t*pulse(t, 1, 2)").derivative(1.0) == 1);
  CHECK(of_t("t*pulse(t, 1, 2)").derivative(2.0) == 0);
}

TEST_CASE("A derivative that does not exist is an error") {
  CHECK_THAT(message_of<ComputationError>([] { of_t("sqrt(t)").derivative(0.0); }),
             Contains("no finite first derivative"));
  CHECK(of_t("t^1.5").derivative(0.0) == 0);
  CHECK_THAT(message_of<ComputationError>([] { of_t("t^1.5").derivative(0.0, 2); }),
             Contains("no finite second derivative"));
}

TEST_CASE("Break points are found if both sides of a comparison are linear in the argument") {
  using Points = std::vector<double>;
  CHECK(of_t("sin(t)").break_points().empty());
  CHECK(of_t("-1e3*(t > 0.01)").break_points() == Points{0.01});
  CHECK(of_t("if(2*t - 1 <= 0.5, 1, t)").break_points() == Points{0.75});
  CHECK(of_t("step(t, t0, t0+0.5) + step(t, 3, 4)", {{"t0", 1}}).break_points() == Points{1, 1.5, 3, 4});
  CHECK(of_t("pulse(t/2, 1, 2)").break_points() == Points{2, 4});
  CHECK(of_t("abs(t - 1) + max(t, 3-2*t)").break_points() == Points{1});
  CHECK(of_t("ramp(-t, -3, -1) && t > 7").break_points() == Points{1, 3, 7});
  CHECK(of_t("if(t > 1, step(t, 2, 3), abs(t))").break_points() == Points{0, 1, 2, 3});
  CHECK(Expression("if(q > 1, step(t, 2, 3), v)", {"q", "v", "t"}).break_points(0) == Points{1});
  CHECK(Expression("if(q > 1, step(t, 2, 3), v)", {"q", "v", "t"}).break_points(2) == Points{2, 3});
  CHECK(Expression("if(q > t, 1, 2)", {"q", "t"}).break_points(1).empty());  // the comparison depends on both variables
}

TEST_CASE("A formula may use tables from files, relative to the folder of the formula") {
  const bielle::test::TemporaryFolder folder;
  folder.file("curve.csv", "t, value\n0, 0\n1, 2\n3, 0\n");
  const auto formula = [&](const std::string& text) { return Expression(text, {"t"}, {}, folder.path()); };
  const Expression straight = formula("3*table('curve.csv', t)"), smooth = formula("spline(\"curve.csv\", t)");
  CHECK(straight(0.5) == 3);
  CHECK(straight(2.0) == 3);
  CHECK(straight.derivative(0.5) == 6);
  CHECK(straight.derivative(1.0) == -3);  // slope on the right
  CHECK(straight.derivative(3.0) == -3);  // slope of the last piece, since nothing follows it
  CHECK(straight.break_points() == std::vector<double>{0, 1, 3});
  CHECK(formula("table('curve.csv', 2*t)").break_points() == std::vector<double>{0, 0.5, 1.5});
  // The spline through three points is the parabola t (3 - t).
  CHECK_THAT(smooth(2.0), WithinAbs(2, rounding));
  CHECK_THAT(smooth.derivative(2.0), WithinAbs(-1, 4 * rounding));
  CHECK_THAT(smooth.derivative(2.0, 2), WithinAbs(-2, 4 * rounding));
  CHECK_THAT(message_of<ComputationError>([&] { straight(3.5); }),
             Contains("3.5 is outside the table") && Contains("runs from 0 to 3") && Contains("at t = 3.5"));
  CHECK_THAT(message_of<InputError>([&] { formula("table('curv.csv', t)"); }),
             Contains("curv.csv: there is no such file"));
  CHECK(Expression("table('" + folder.path() + "/curve.csv', t)", {"t"}, {}, "/elsewhere")(1.0) == 2);
}

TEST_CASE("An expression may be evaluated by many threads at once") {
  const Expression formula = of_t("sin(t)^2 + step(t, 0, 1)*cos(t)^2");
  std::vector<double> sums(8, 0);
  std::vector<std::thread> threads;
  for (double& sum : sums)
    threads.emplace_back([&sum, formula] {
      for (int i = 0; i < 2000; ++i) sum += formula(1 + 1e-3 * i) - Expression("1+t", {"t"})(0.0);
    });
  for (std::thread& thread : threads) thread.join();
  for (const double sum : sums) CHECK_THAT(sum, WithinAbs(0, 2000 * rounding));
}

TEST_CASE("Decimal points do not depend on the locale") {
  const char* set = std::setlocale(LC_ALL, "de_DE.UTF-8");
  CHECK(constant("1.5+1") == 2.5);
  if (set != nullptr) std::setlocale(LC_ALL, "C");
}

}  // namespace test_expression
