// Journal bearings of finite length against Reynolds' equation in two dimensions (tests/references/journal_film.py).
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/joints/flexible/journal_bearing.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using bielle::test::ReferenceTable;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace test_journal_tables {
namespace {

constexpr double R = 0.03, c = 6e-5, mu = 0.03, omega = 250;
constexpr double stated = 1e-3;  // accuracy of the law (journal_film.hpp)

BearingLaw::Force held_at(double slenderness, double eccentricity) {
  Vector6 e = Vector6::Zero(), v = Vector6::Zero();
  e[0] = eccentricity * c;
  v[5] = omega;
  return JournalBearingLaw({2 * R, 2 * R * slenderness, c, mu}, true).calc(e, v);
}

/// Returns W over mu omega D L (R/c)^2.
double number_of(double load, double slenderness) {
  return load / (mu * omega * 2 * R * 2 * R * slenderness * std::pow(R / c, 2));
}

}  // namespace

TEST_CASE("bearings of finite length have the load and the attitude of the half film in two dimensions") {
  const ReferenceTable table("journal_film");
  for (const double slenderness : {1.0, 0.5, 0.25})
    for (const double eccentricity : {0.1, 0.4, 0.6, 0.8, 0.9}) {
      CAPTURE(slenderness, eccentricity);
      const std::string name = fmt::format("half.{}.{}", slenderness, eccentricity);
      const Vector6 N = held_at(slenderness, eccentricity).N;
      const double load = number_of(N.norm(), slenderness), angle = std::atan2(-N[1], N[0]) * 180 / std::numbers::pi;
      CHECK_THAT(load, WithinRel(table(name + ".load"), stated));
      CHECK_THAT(angle, WithinAbs(table(name + ".angle"), stated * 180 / std::numbers::pi));
    }
}

TEST_CASE("bearings of finite length have the eight coefficients of the half film in two dimensions") {
  const ReferenceTable table("journal_film");
  for (const double slenderness : {1.0, 0.5, 0.25})
    for (const double eccentricity : {0.4, 0.8}) {
      const BearingLaw::Force force = held_at(slenderness, eccentricity);
      const double size = force.N.norm();
      const auto exact = [&](const char* kind) {
        Matrix2 matrix;
        for (const int row : {0, 1})
          for (const int column : {0, 1})
            matrix(row, column) =
                table(fmt::format("half.{}.{}.{}_{}{}", slenderness, eccentricity, kind, "xy"[row], "xy"[column]));
        return matrix;
      };
      CAPTURE(slenderness, eccentricity);
      const Matrix2 K = exact("stiffness"), C = exact("damping");
      CHECK((force.by_e.topLeftCorner<2, 2>() * c / size - K).norm() < stated * K.norm());
      CHECK((force.by_v.topLeftCorner<2, 2>() * c * omega / size - C).norm() < stated * C.norm());
    }
}

}  // namespace test_journal_tables
