// Tests of tables of two variables: polynomials that they reproduce, derivatives, and errors in files.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/expression.hpp"
#include "reduce/common/formula/surface.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::ComputationError;
using bielle::Expression;
using bielle::InputError;
using bielle::Interpolation;
using bielle::Surface;
using bielle::test::message_of;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace test_surface {

template <class Function>
Surface on_grid(const Function& f, Interpolation::Kind kind) {
  Eigen::VectorXd x(5), y(6);
  x << -1, -0.3, 0.1, 1.5, 1.9;
  y << 0, 0.4, 1, 1.1, 2, 3;
  Eigen::MatrixXd z(5, 6);
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 6; ++j) z(i, j) = f(x(i), y(j));
  return {x, y, z, kind, "grid"};
}

const std::string grid_of_numbers = "x,y,z\n0,0,1\n0,2,3\n1,0,5\n1,2,-1\n";  // 1 + y + 4 x - 4 x y

}  // namespace test_surface
using namespace test_surface;

TEST_CASE("A bicubic table reproduces every bicubic polynomial with its derivatives") {
  const auto p = [](double s) { return 1 - 2 * s + 0.5 * s * s + 0.3 * s * s * s; };
  const auto p1 = [](double s) { return -2 + s + 0.9 * s * s; };
  const auto p2 = [](double s) { return 1 + 1.8 * s; };
  const auto q = [](double s) { return 2 + s - s * s + 0.1 * s * s * s; };
  const auto q1 = [](double s) { return 1 - 2 * s + 0.3 * s * s; };
  const auto q2 = [](double s) { return -2 + 0.6 * s; };
  const Surface surface = on_grid([&](double x, double y) { return p(x) * q(y); }, Interpolation::Kind::cubic);
  for (double x = -1; x <= 1.9; x += 0.07)
    for (double y = 0; y <= 3; y += 0.11) {
      const Surface::Values z = surface(x, y);
      CHECK_THAT(z.value, WithinAbs(p(x) * q(y), 1e-12));
      CHECK_THAT(z.x, WithinAbs(p1(x) * q(y), 1e-11));
      CHECK_THAT(z.y, WithinAbs(p(x) * q1(y), 1e-11));
      CHECK_THAT(z.xx, WithinAbs(p2(x) * q(y), 1e-10));
      CHECK_THAT(z.xy, WithinAbs(p1(x) * q1(y), 1e-10));
      CHECK_THAT(z.yy, WithinAbs(p(x) * q2(y), 1e-10));
    }
}

TEST_CASE("A bilinear table reproduces bilinear functions, and has the derivatives of the cell on its right") {
  const Surface exact =
      on_grid([](double x, double y) { return 1 + 2 * x - 3 * y + 4 * x * y; }, Interpolation::Kind::linear);
  const Surface::Values z = exact(0.7, 2.3);
  CHECK_THAT(z.value, WithinAbs(1 + 1.4 - 6.9 + 4 * 0.7 * 2.3, 1e-13));
  CHECK_THAT(z.x, WithinAbs(2 + 4 * 2.3, 1e-13));
  CHECK_THAT(z.y, WithinAbs(-3 + 4 * 0.7, 1e-13));
  CHECK_THAT(z.xy, WithinAbs(4, 1e-13));
  const Surface bent =
      on_grid([](double x, double y) { return std::abs(x - 0.1) + std::abs(y - 1); }, Interpolation::Kind::linear);
  CHECK_THAT(bent(0.1, 1).x, WithinAbs(1, 1e-13));
  CHECK_THAT(bent(0.1, 1, false, true).x, WithinAbs(-1, 1e-13));
  CHECK_THAT(bent(0.1, 1, false, true).y, WithinAbs(1, 1e-13));
  CHECK_THAT(bent(0.1, 1, true, false).y, WithinAbs(-1, 1e-13));
}

TEST_CASE("A formula reads tables of two variables, with exact derivatives along each") {
  const bielle::test::TemporaryFolder folder;
  folder.file("grid.csv", grid_of_numbers);
  std::string wavy;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      wavy += fmt::format("{} {} {}\n", 0.5 * i, 0.4 * j, std::sin(0.5 * i) * std::cos(0.4 * j));
  folder.file("wavy.txt", wavy);
  const auto formula = [&](const std::string& text) { return Expression(text, {"x", "y"}, {}, folder.path()); };
  const std::vector<double> quarter = {0.25, 1};
  const Expression plain = formula("2*table2('grid.csv', x, y)");
  CHECK_THAT(plain(quarter), WithinAbs(2 * (1 + 1 + 1 - 1), 1e-14));
  CHECK_THAT(plain.derivative(quarter, 0), WithinAbs(2 * (4 - 4), 1e-14));
  CHECK_THAT(plain.derivative(quarter, 1), WithinAbs(2 * (1 - 1), 1e-14));
  CHECK(formula("table2('grid.csv', 0.25, 2)")(quarter) == 1 + 2 + 1 - 2);
  // Both arguments change along a curve in the grid; the derivatives are compared with differences of values and of
  // first derivatives.
  const Expression smooth = formula("spline2('wavy.txt', 1 + sin(x), x*x + 0.1*y)");
  const double h = 1e-5;
  const std::vector<double> at = {0.7, 0.3}, above = {0.7 + h, 0.3}, below = {0.7 - h, 0.3};
  CHECK_THAT(smooth.derivative(at, 0), WithinAbs((smooth(above) - smooth(below)) / (2 * h), 1e-9));
  CHECK_THAT(smooth.derivative(at, 0, 2),
             WithinAbs((smooth.derivative(above, 0) - smooth.derivative(below, 0)) / (2 * h), 1e-8));
  std::vector<double> gradient(2);
  CHECK(smooth.value_and_gradient(at, gradient) == smooth(at));
  CHECK_THAT(gradient[0], WithinAbs(smooth.derivative(at, 0), 1e-14));
  CHECK_THAT(gradient[1], WithinAbs(smooth.derivative(at, 1), 1e-14));
  CHECK(formula("table2('grid.csv', x, 1)").break_points() == std::vector<double>{0, 1});
}

TEST_CASE("Tables of two variables are not extrapolated, and files that are no grid are refused") {
  const bielle::test::TemporaryFolder folder;
  folder.file("grid.csv", grid_of_numbers);
  const auto value = [&](const std::string& text) { return Expression(text, {"t"}, {}, folder.path())(0.5); };
  CHECK_THAT(message_of<ComputationError>([&] { value("table2('grid.csv', 3*t, 1)"); }),
             Contains("x = 1.5 is outside the table") && Contains("from 0 to 1"));
  CHECK_THAT(message_of<ComputationError>([&] { value("spline2('grid.csv', t, -t)"); }),
             Contains("y = -0.5 is outside the table") && Contains("from 0 to 2"));
  const auto why_wrong = [&](const std::string& rows) {
    folder.file("wrong.csv", rows);
    return message_of<InputError>([&] { value("table2('wrong.csv', t, t)"); });
  };
  CHECK_THAT(why_wrong("0,0,1\n0,1,1\n1,0,1\n"), Contains("2 values of y") && Contains("found 3 rows"));
  CHECK_THAT(why_wrong("0,0,1\n0,1,1\n1,0,1\n1,2,1\n"), Contains("expected the point x = 1, y = 1 in row 4"));
  CHECK_THAT(why_wrong("0,0,1\n0,1,1\n"), Contains("at least two values of x"));
  CHECK_THAT(why_wrong("0,0,1\n1,0,1\n"), Contains("at least two values of y"));
  CHECK_THAT(why_wrong("1,0,1\n1,1,1\n0,0,1\n0,1,1\n"), Contains("x must ascend, but 0 follows 1"));
  CHECK_THAT(why_wrong("0,1,1\n0,0,1\n1,1,1\n1,0,1\n"), Contains("y must ascend, but 0 follows 1"));
  CHECK_THAT(why_wrong("0,0\n"), Contains("wrong.csv:1"));
  CHECK_THAT(message_of<InputError>([&] { value("table2('grid.csv', t)"); }), Contains("too few arguments"));
}
