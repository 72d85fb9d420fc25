#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/interpolation.hpp"
#include "tests/support/messages.hpp"

using bielle::Interpolation;
using bielle::test::message_of;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

template <class Function>
Interpolation through(const Eigen::VectorXd& x, Function&& f, Interpolation::Kind kind) {
  return {x, x.unaryExpr(f), kind, "curve"};
}

}  // namespace

TEST_CASE("A cubic spline reproduces every cubic, whatever its points") {
  const auto f = [](double x) { return 2 - x + 3 * x * x - 0.5 * x * x * x; };
  Eigen::VectorXd x(6);
  x << -1, -0.3, 0.1, 1.5, 1.6, 4;
  for (const Eigen::Index n : {4, 5, 6}) {
    const Interpolation spline = through(x.head(n), f, Interpolation::Kind::cubic);
    for (double at = x(0); at <= x(n - 1); at += 0.05) {
      const Interpolation::Values values = spline(at);
      // The error is a few roundings of values up to 40, divided by the smallest interval 0.1 for each derivative.
      CHECK_THAT(values.value, WithinAbs(f(at), 1e-13));
      CHECK_THAT(values.slope, WithinAbs(-1 + 6 * at - 1.5 * at * at, 1e-12));
      CHECK_THAT(values.curvature, WithinAbs(6 - 3 * at, 1e-11));
    }
  }
}

TEST_CASE("A spline through three points is a parabola, through two a straight line") {
  const auto square = [](double x) { return x * x; };
  const Interpolation parabola = through(Eigen::Vector3d(0, 1, 3), square, Interpolation::Kind::cubic);
  CHECK_THAT(parabola(2.0).value, WithinAbs(4, 1e-14));
  CHECK_THAT(parabola(2.0).curvature, WithinAbs(2, 1e-14));
  const Interpolation line = through(Eigen::Vector2d(1, 3), square, Interpolation::Kind::cubic);
  CHECK(line(2.0).value == 5);
  CHECK(line(2.0).slope == 4);
  CHECK(line(2.0).curvature == 0);
}

TEST_CASE("A cubic spline converges with fourth order, its second derivative with second order") {
  std::vector<double> error, error_of_curvature;
  for (const int n : {40, 80, 160, 320}) {
    const Interpolation spline = through(
        Eigen::VectorXd::LinSpaced(n + 1, 0, 3), [](double x) { return std::exp(x); }, Interpolation::Kind::cubic);
    error.push_back(0);
    error_of_curvature.push_back(0);
    for (double x = 0; x <= 3; x += 0.001) {
      error.back() = std::max(error.back(), std::abs(spline(x).value - std::exp(x)));
      error_of_curvature.back() = std::max(error_of_curvature.back(), std::abs(spline(x).curvature - std::exp(x)));
    }
  }
  for (std::size_t i = 1; i < error.size(); ++i) {
    CHECK_THAT(std::log2(error[i - 1] / error[i]), WithinAbs(4, 0.15));
    CHECK_THAT(std::log2(error_of_curvature[i - 1] / error_of_curvature[i]), WithinAbs(2, 0.15));
  }
}

TEST_CASE("A periodic spline repeats itself, and converges with fourth order to a periodic function") {
  const auto f = [](double x) { return std::exp(std::sin(x)); };
  std::vector<double> error;
  for (const int n : {16, 32, 64}) {
    // The intervals are unequal.
    Eigen::VectorXd x(n + 1), y(n + 1);
    for (int k = 0; k <= n; ++k) x(k) = 2 * M_PI * (k + 0.2 * std::sin(2 * M_PI * k / n)) / n;
    for (int k = 0; k <= n; ++k) y(k) = f(x(k));
    y(n) = y(0);
    const Interpolation spline(x, y, Interpolation::Kind::periodic, "curve");
    error.push_back(0);
    for (double at = 0; at < 2 * M_PI; at += 0.01)
      error.back() = std::max(error.back(), std::abs(spline(at).value - f(at)));
    for (const double at : {0.0, 1.3, 5.9}) {
      CHECK_THAT(spline(at + 6 * M_PI).value, WithinAbs(spline(at).value, 1e-13));
      CHECK_THAT(spline(at - 4 * M_PI).slope, WithinAbs(spline(at).slope, 1e-12));
    }
    // The curve is smooth where its ends meet.
    const double end = 2 * M_PI - 1e-9;
    CHECK_THAT(spline(end).slope, WithinAbs(spline(0.0).slope, 1e-7));
    CHECK_THAT(spline(end).curvature, WithinAbs(spline(0.0).curvature, 1e-7));
  }
  for (std::size_t k = 1; k < error.size(); ++k) CHECK_THAT(std::log2(error[k - 1] / error[k]), WithinAbs(4, 0.5));
  const auto message = [](const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    return message_of<bielle::InputError>([&] { Interpolation(x, y, Interpolation::Kind::periodic, "curve"); });
  };
  CHECK_THAT(message(Eigen::Vector4d(0, 1, 2, 3), Eigen::Vector4d(1, 2, 3, 2)), Catch::Contains("repeat the first"));
  CHECK_THAT(message(Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(1, 2, 1)), Catch::Contains("three points"));
}

TEST_CASE("The integral is the sum over the pieces, over any number of periods") {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(5, -1, 2);
  const Interpolation cubic(x, x.array().cube() - 2 * x.array().square() + 3, Interpolation::Kind::cubic, "curve");
  const auto primitive = [](double at) { return std::pow(at, 4) / 4 - 2 * std::pow(at, 3) / 3 + 3 * at; };
  for (const double at : {-1.0, -0.7, 0.5, 1.99, 2.0})
    CHECK_THAT(cubic.integral(at), WithinAbs(primitive(at) - primitive(-1), 1e-13));
  const Interpolation pieces(Eigen::Vector3d(0, 1, 3), Eigen::Vector3d(0, 2, 0), Interpolation::Kind::linear, "curve");
  CHECK_THAT(pieces.integral(0.5), WithinAbs(0.25, 1e-14));
  CHECK_THAT(pieces.integral(2), WithinAbs(2.5, 1e-14));
  const Interpolation periodic(Eigen::Vector4d(0.5, 1, 2, 3), Eigen::Vector4d(1, 2, -0.5, 1),
                               Interpolation::Kind::periodic, "curve");
  for (const double at : {0.5, 0.6, 1.7, 2.9}) {
    CHECK_THAT(periodic.integral(at + 7.5) - periodic.integral(at), WithinAbs(3 * periodic.integral(3), 1e-13));
    CHECK_THAT(periodic.integral(at - 5) - periodic.integral(at), WithinAbs(-2 * periodic.integral(3), 1e-13));
    const double h = 1e-5;
    CHECK_THAT((periodic.integral(at + h) - periodic.integral(at - h)) / (2 * h), WithinAbs(periodic(at).value, 1e-8));
  }
}

TEST_CASE("The slope at a point between straight pieces is that of the requested side") {
  const Interpolation pieces(Eigen::Vector3d(0, 1, 3), Eigen::Vector3d(0, 2, 0), Interpolation::Kind::linear, "curve");
  CHECK(pieces(0.5).value == 1);
  CHECK(pieces(1.0).value == 2);
  CHECK(pieces(1.0, true).slope == -1);
  CHECK(pieces(1.0, false).slope == 2);
  CHECK(pieces(3.0, true).slope == -1);
  CHECK(pieces(0.0, false).slope == 2);
  CHECK(pieces(0.5).curvature == 0);
}

TEST_CASE("A function through points is not extrapolated") {
  const Interpolation pieces(Eigen::Vector2d(0, 1), Eigen::Vector2d(0, 2), Interpolation::Kind::linear, "curve");
  CHECK_THAT(message_of<bielle::ComputationError>([&] { pieces(1.1); }),
             Contains("1.1 is outside the table 'curve', which runs from 0 to 1"));
  CHECK_THROWS_AS(pieces(-0.1), bielle::ComputationError);
  CHECK_THROWS_AS(pieces(std::nan("")), bielle::ComputationError);
  CHECK_THAT(pieces(1 + 1e-12).value, WithinAbs(2, 1e-11));  // a sum of time steps may exceed the end by a rounding
}

TEST_CASE("Points must be at least two and ascend") {
  const auto why = [](Eigen::VectorXd x) {
    return message_of<bielle::InputError>([&] { Interpolation(x, x, Interpolation::Kind::cubic, "curve"); });
  };
  CHECK_THAT(why(Eigen::VectorXd::Zero(1)), Contains("curve: an interpolation needs at least two points"));
  CHECK_THAT(why(Eigen::Vector3d(0, 2, 2)), Contains("the first column must ascend, but 2 follows 2"));
}
