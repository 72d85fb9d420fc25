// Journal bearings with Reynolds' condition at the edges of their film: against Reynolds' equation in two dimensions
// (tests/references/journal_film.py), closed forms at the limits of short and long bearings, and published tables.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/joints/flexible/film_map.hpp"
#include "mechanism/joints/flexible/journal_bearing.hpp"
#include "mechanism/joints/flexible/reynolds_film.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using bielle::test::ReferenceTable;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace test_journal_cavitation {
namespace {

using std::numbers::pi;
constexpr double R = 0.03, c = 6e-5, mu = 0.03, omega = 250;

BearingLaw::Force steady(double slenderness, double eccentricity, Cavitation cavitation) {
  Vector6 e = Vector6::Zero(), v = Vector6::Zero();
  e[0] = eccentricity * c;
  v[5] = omega;
  return JournalBearingLaw({2 * R, 2 * R * slenderness, c, mu}, true, cavitation).calc(e, v);
}

struct Number {
  double load, angle;
};

/// Returns W over mu omega D L (R/c)^2, and the angle between load and eccentricity in degrees.
Number number_of(double slenderness, double eccentricity, Cavitation cavitation) {
  const Vector6 N = steady(slenderness, eccentricity, cavitation).N;
  return {N.norm() / (mu * omega * 2 * R * 2 * R * slenderness * std::pow(R / c, 2)),
          std::atan2(-N[1], N[0]) * 180 / pi};
}

Vector2 shape(double slenderness, double a, double d) {
  return JournalFilm(slenderness, Cavitation::reynolds).shape(a, d).W;
}

}  // namespace

TEST_CASE("films with Reynolds' condition have the load and the attitude of the obstacle problem") {
  const ReferenceTable table("journal_film");
  for (const double slenderness : {2.0, 1.0, 0.5, 0.25})
    for (const double eccentricity : {0.1, 0.4, 0.6, 0.8, 0.9}) {
      CAPTURE(slenderness, eccentricity);
      const std::string name = fmt::format("reynolds.{}.{}", slenderness, eccentricity);
      const Number found = number_of(slenderness, eccentricity, Cavitation::reynolds);
      CHECK_THAT(found.load, WithinRel(table(name + ".load"), 3e-3));
      CHECK_THAT(found.angle, WithinAbs(table(name + ".angle"), 0.1));
    }
}

TEST_CASE("films with Reynolds' condition have its eight coefficients, and their damping is symmetric") {
  const ReferenceTable table("journal_film");
  for (const double slenderness : {1.0, 0.5})
    for (const double eccentricity : {0.4, 0.8}) {
      CAPTURE(slenderness, eccentricity);
      const BearingLaw::Force force = steady(slenderness, eccentricity, Cavitation::reynolds);
      const double size = force.N.norm();
      const auto exact = [&](const char* kind) {
        Matrix2 matrix;
        for (const int row : {0, 1})
          for (const int column : {0, 1})
            matrix(row, column) =
                table(fmt::format("reynolds.{}.{}.{}_{}{}", slenderness, eccentricity, kind, "xy"[row], "xy"[column]));
        return matrix;
      };
      const Matrix2 K = exact("stiffness"), C = exact("damping");
      const Matrix2 damping = force.by_v.topLeftCorner<2, 2>() * c * omega / size;
      CHECK((force.by_e.topLeftCorner<2, 2>() * c / size - K).norm() < 5e-3 * K.norm());
      CHECK((damping - C).norm() < 5e-3 * C.norm());
      CHECK(std::abs(damping(0, 1) - damping(1, 0)) < 5e-3 * damping.norm());
    }
}

// The films of the tables are supplied at the widest gap, and begin there: ours begin before it.
TEST_CASE("films with Reynolds' condition are closer to DIN 31652 than the half film") {
  const ReferenceTable table("journal_film");
  for (const double slenderness : {1.0, 0.5, 0.25})
    for (const double eccentricity : {0.1, 0.2, 0.4, 0.6, 0.8, 0.9}) {
      CAPTURE(slenderness, eccentricity);
      const std::string name = fmt::format("published.{}.{}", slenderness, eccentricity);
      const double load = table(name + ".load"), angle = table(name + ".angle");
      const Number found = number_of(slenderness, eccentricity, Cavitation::reynolds),
                   half = number_of(slenderness, eccentricity, Cavitation::half);
      CHECK(std::abs(found.load - load) <= std::max(std::abs(half.load - load), 5e-3 * load));
      CHECK_THAT(found.load, WithinRel(load, slenderness < 1 ? 5e-3 : 0.025));
      CHECK(std::abs(found.angle - angle) < std::abs(half.angle - angle));
      CHECK_THAT(found.angle, WithinAbs(angle, slenderness < 1 ? 1.5 : 4.5));
    }
}

// T. Someya (ed.), Journal-Bearing Databook (Springer, 1989), pages 14 and 17, bearings with two axial grooves, as
// quoted by VictorLier/Tribology (Bearing_Table_Someya_corrected.m). The film of the table begins at one of the
// grooves, at right angles to the load, so that a full bearing cannot agree to the digit: stiffness and damping differ
// by 5 % at L/D = 0.5 and 12 % at 1, those of the half film by 10 and 18 %.
TEST_CASE("films with Reynolds' condition are closer to Someya's bearing with two grooves than the half film") {
  struct Row {
    double slenderness, S;
    std::array<double, 4> K, C;  // xx, xy, yx, yy; x along the load, y towards which the shaft turns
  };
  for (const Row& row : {Row{0.5, 0.0926, {7.35, 4.46, 0.527, 1.78}, {8.17, 2.05, 2.05, 1.24}},
                         Row{1, 0.0469, {6.10, 3.82, 0.420, 1.74}, {8.08, 2.15, 2.15, 1.34}}}) {
    CAPTURE(row.slenderness);
    struct Distance {
      double load, K, C;
    };
    const auto distance = [&](Cavitation cavitation) -> Distance {
      const BearingLaw::Force force = steady(row.slenderness, 0.8, cavitation);
      const double size = force.N.norm();
      const Vector2 load = force.N.head<2>() / size;
      Matrix2 axes;
      axes << load, Vector2(-load.y(), load.x());
      const auto relative = [&](const Matrix2& found, const std::array<double, 4>& given) {
        Matrix2 expected;
        expected << given[0], given[1], given[2], given[3];
        return (axes.transpose() * found * axes - expected).norm() / expected.norm();
      };
      return {std::abs(2 * pi * row.S * number_of(row.slenderness, 0.8, cavitation).load - 1),
              relative(force.by_e.topLeftCorner<2, 2>() * c / size, row.K),
              relative(force.by_v.topLeftCorner<2, 2>() * c * omega / size, row.C)};
    };
    const Distance found = distance(Cavitation::reynolds), half = distance(Cavitation::half);
    CAPTURE(found.load, half.load, found.K, half.K, found.C, half.C);
    CHECK(found.load < half.load);
    CHECK(found.K < half.K);
    CHECK(found.C < half.C);
  }
}

TEST_CASE("the force of the discrete film converges with the square of its cells") {
  for (const double slenderness : {0.5, 2.0})
    for (const double e : {0.3, 0.9}) {
      CAPTURE(slenderness, e);
      const double a = 0.3 * e, d = std::sqrt(e * e - a * a);
      const Vector2 exact = reynolds_film(a, d, slenderness, {768, 32});
      const auto error = [&](int around, int along) {
        return (reynolds_film(a, d, slenderness, {around, along}) - exact).norm() / exact.norm();
      };
      CHECK(error(160, 10) < 2e-3);
      const double order = std::log2(error(96, 6) / error(192, 12));
      CHECK(order > 1.5);
    }
}

TEST_CASE("at the limit of zero length the film is that of a short bearing") {
  for (const double e : {0.0, 0.5, 0.9}) {
    const Vector2 W = shape(0.005, 0.6 * e, 0.8 * e), expected = JournalFilm(0).shape(0.6 * e, 0.8 * e).W;
    CHECK((W - expected).norm() < 1e-3 * expected.norm());
  }
}

// A. Sommerfeld, Z. Math. Phys. 50 (1904) 97: with any constant added to the pressure the force is the same. The ends
// reach over many radii into the bearing.
TEST_CASE("a film without supply fills a very long bearing and has Sommerfeld's pressure per length") {
  for (const double eps : {0.3, 0.6, 0.8}) {
    CAPTURE(eps);
    const auto force = [&](double slenderness) {
      return Vector2(std::pow(slenderness, 3) * reynolds_film(0, eps, slenderness, {320, 24}));
    };
    const double e2 = eps * eps, expected = 6 * pi / ((2 + e2) * std::sqrt(1 - e2));
    const Vector2 per_length = (force(40) - force(32)) / 8;
    CHECK_THAT(per_length[0], WithinRel(expected, 1e-3));
    CHECK(std::abs(per_length[1]) < 1e-2 * expected);
  }
}

TEST_CASE("the map of the film has its force between the nodes") {
  const double slenderness = 0.7;
  const auto difference = [&](double a, double d) {
    const Vector2 exact = reynolds_film(a, d, slenderness);
    return (shape(slenderness, a, d) - exact).norm() / exact.norm();
  };
  for (int k = 0; k <= 12; ++k) {
    const double angle = -pi + k * pi / 6 + 0.1;
    CAPTURE(angle);
    for (const double e : {0.05, 0.3, 0.55, 0.77, 0.9, 0.95})
      CHECK(difference(e * std::cos(angle), e * std::sin(angle)) < 1e-3);
    CHECK(difference(0.99 * std::cos(angle), 0.99 * std::sin(angle)) < 5e-3);
  }
  CHECK(difference(0, 0) < 1e-6);
}

TEST_CASE("the map is the same to the bit whenever it is made") {
  const FilmMap again(0.7);
  for (const double e : {0.1, 0.6, 0.95, 0.9999})
    for (const std::size_t k : {0U, 1U}) {
      const auto found = again.difference(0.6 * e, -0.8 * e)[k],
                 first = FilmMap::of(0.7)->difference(0.6 * e, -0.8 * e)[k];
      CHECK(found.value == first.value);
      CHECK(found.gradient == first.gradient);
    }
}

TEST_CASE("the film with Reynolds' condition has a mirror image, and the gradient of its force") {
  const JournalFilm film(0.7, Cavitation::reynolds);
  for (const double e : {0.0, 0.3, 0.9, 0.99, 0.9999})
    for (const double angle : {0.0, 0.4, 1.5, 2.2, pi}) {
      CAPTURE(e, angle);
      const double a = e * std::cos(angle), d = e * std::sin(angle), step = 1e-5 * (1 - e);
      const JournalFilm::Shape at = film.shape(a, d), image = film.shape(a, -d);
      CHECK((image.W - Vector2(at.W[0], -at.W[1])).norm() < 1e-9 * at.W.norm());
      Matrix2 slope;
      slope.col(0) = (film.shape(a + step, d).W - film.shape(a - step, d).W) / (2 * step);
      slope.col(1) = (film.shape(a, d + step).W - film.shape(a, d - step).W) / (2 * step);
      CHECK((at.gradient - slope).norm() < 1e-5 * slope.norm());
    }
}

TEST_CASE("the force turns with the bearing, reverses with the rotation, and squeezing does not turn it") {
  const JournalBearingLaw law({2 * R, 2 * R * 0.7, c, mu}, true, Cavitation::reynolds);
  const auto force = [&](const Vector2& place, const Vector2& rate, double speed) {
    Vector6 e = Vector6::Zero(), v = Vector6::Zero();
    e.head<2>() = c * place;
    v.head<2>() = c * rate;
    v[5] = speed;
    return Vector2(law.calc(e, v).N.head<2>());
  };
  const Vector2 place(0.5, -0.2), rate(30, 80), N = force(place, rate, omega);
  const Matrix2 turn = Eigen::Rotation2Dd(2.1).toRotationMatrix();
  CHECK((force(turn * place, turn * rate, omega) - turn * N).norm() < 1e-9 * N.norm());
  const Vector2 mirror(1, -1);
  CHECK((force(place.cwiseProduct(mirror), rate.cwiseProduct(mirror), -omega) - N.cwiseProduct(mirror)).norm() <
        1e-9 * N.norm());
  const Vector2 squeezed = force({0.5, 0}, {100, 0}, 0), opened = force({0.5, 0}, {-100, 0}, 0);
  CHECK(std::abs(squeezed[1]) < 1e-9 * squeezed[0]);
  CHECK(squeezed[0] > -opened[0]);
  CHECK(opened[0] < 0);
  CHECK(force({0.5, 0}, {0, 0}, 0).isZero(0));
}

TEST_CASE("a short bearing is the same with both conditions, and long ones are refused") {
  const JournalBearingLaw half({2 * R, R, c, mu}, false), both({2 * R, R, c, mu}, false, Cavitation::reynolds);
  const Vector6 e = (Vector6() << 0.3 * c, -0.4 * c, 0, 0, 0, 0).finished(),
                v = (Vector6() << 1e-3, 2e-3, 0, 0, 0, 100).finished();
  CHECK(half.calc(e, v).N == both.calc(e, v).N);
  const auto entry = [](const char* keys) {
    return fmt::format(
        "nodes: {{shaft: {{position: [0, 0, 0]}}}}\nelements: {{shaft: {{type: rigid_body, node: shaft, mass: 1, "
        "inertia: [1, 1, 1]}}}}\njoints: {{film: {{type: journal_bearing, nodes: [ground, shaft], axis: [0, 0, "
        "1], diameter: 0.06, clearance: 6e-5, viscosity: 0.03, {}}}}}\n",
        keys);
  };
  using bielle::test::model_from_text;
  CHECK_NOTHROW(model_from_text(entry("length: 0.13")));
  CHECK_NOTHROW(model_from_text(entry("length: 0.13, model: short, cavitation: reynolds")));
  CHECK_THROWS_WITH(model_from_text(entry("length: 0.13, cavitation: reynolds")),
                    Catch::Matchers::Contains("expected at most 2 diameters with `cavitation: reynolds`"));
  CHECK_THROWS_WITH(model_from_text(entry("length: 0.06, cavitation: reynold")), Catch::Matchers::Contains("reynolds"));
}

}  // namespace test_journal_cavitation
