// Forces and coefficients from tables: lines between the points, and their continuation.
#include <fstream>

#include <catch2/catch.hpp>

#include "mechanism/laws/film_coefficients.hpp"
#include "mechanism/laws/force_curve.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;

TEST_CASE(
    "a curve of force has the slope to the right at its points, goes on beyond them, and has its area as energy") {
  const bielle::test::TemporaryFolder folder;
  std::ofstream(folder / "curve.txt") << "-1 -4\n0.5 1\n2 3\n3 9\n";
  const ForceCurve curve = ForceCurve::from_file(folder / "curve.txt");
  struct Point {
    double x, force, slope, energy;
  };
  // f(0) = -2/3. The areas between the points are those of trapezia.
  for (const Point& at :
       {Point{-2, -22.0 / 3, 10.0 / 3, 8}, Point{0, -2.0 / 3, 10.0 / 3, 0}, Point{0.5, 1, 4.0 / 3, 1.0 / 12},
        Point{2, 3, 6, 1.0 / 12 + 3}, Point{3, 9, 6, 1.0 / 12 + 9}, Point{4, 15, 6, 1.0 / 12 + 21}}) {
    CAPTURE(at.x);
    CHECK(curve(at.x).force == Approx(at.force));
    CHECK(curve(at.x).slope == Approx(at.slope));
    CHECK(curve.energy(at.x) == Approx(at.energy).margin(1e-14));
  }
}

TEST_CASE("film coefficients lie on lines between the speeds of the table, and are constant beyond them") {
  Eigen::MatrixXd table(3, FilmCoefficients::columns(2));
  table << 10, 100, 1, 2, 300, 5, 6, 7, 8,  //
      20, 200, 3, -2, 500, 7, 6, 3, 9,      //
      40, 400, 3, -2, 500, 7, 6, 3, 9;
  const FilmCoefficients film(2, table, "table");
  for (const double speed : {-5.0, 10.0, 12.0, 30.0, 40.0, 100.0}) {
    CAPTURE(speed);
    const FilmCoefficients::At at = film(speed);
    const bool inside = speed > 10 && speed < 40;
    CHECK(at.K(0, 0) == Approx(speed < 10 ? 100 : speed > 40 ? 400 : 10 * speed));
    CHECK(at.K_slope(0, 0) == Approx(inside ? 10 : 0));
    CHECK(at.K_slope(0, 1) == Approx(speed == 12 ? 0.2 : 0));
    CHECK(at.K_slope(1, 0) == Approx(speed == 12 ? -0.4 : 0));
    CHECK(at.D_slope(1, 1) == Approx(speed == 12 ? 0.1 : 0));
    CHECK(at.K.bottomRightCorner<4, 4>().isZero(0));
  }
  const FilmCoefficients::At at = film(12);
  Eigen::Matrix2d K, D;
  K << 120, 1.4, 1.2, 340;
  D << 5.4, 6, 6.2, 8.2;
  CHECK((at.K.topLeftCorner<2, 2>() - K).norm() < 1e-12);
  CHECK((at.D.topLeftCorner<2, 2>() - D).norm() < 1e-12);
}
