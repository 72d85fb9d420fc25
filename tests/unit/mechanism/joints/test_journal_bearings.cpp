// Journal bearings against closed forms of short and of long bearings, and cross-coupled bearings at the limit of
// whirl.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/joints/flexible/journal_bearing.hpp"
#include "mechanism/joints/flexible/linear_bearing_law.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/eigenvalues.hpp"
#include "tests/support/model_text.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace test_journal_bearings {

using std::numbers::pi;
constexpr double R = 0.05, L = 0.02, c = 1e-4, mu = 0.02, omega = 300;
constexpr std::array<double, 5> eccentricities{0.05, 0.3, 0.6, 0.8, 0.95};

JournalBearingLaw short_bearing() { return {{2 * R, L, c, mu}, false}; }

Vector6 six(double x, double y, double last) { return (Vector6() << x, y, 0, 0, 0, last).finished(); }

/// W of the pressure on a grid of Theta and z, by successive over-relaxation of the five-point equations.
Vector2 relaxed_shape(double slenderness, double a, double d) {
  constexpr int n = 96, m = 24;                    // over half the circumference and half the length
  const double ds = pi / n, dz = slenderness / m;  // lengths in radii
  std::vector<std::array<double, m + 1>> p(n + 1, std::array<double, m + 1>{});
  const auto cube = [&](double s) { return std::pow(1 - a * std::cos(s) - d * std::sin(s), 3); };
  for (int sweep = 0; sweep < 3000; ++sweep)
    for (int i = 1; i < n; ++i) {
      const double s = -pi / 2 + i * ds, here = cube(s), left = cube(s - ds / 2), right = cube(s + ds / 2);
      const auto row = static_cast<std::size_t>(i);
      for (std::size_t j = 0; j < m; ++j) {  // symmetry at j = 0, zero at j = m
        const double below = j == 0 ? p[row][1] : p[row][j - 1];
        const double sum =
            (left * p[row - 1][j] + right * p[row + 1][j]) / (ds * ds) + here * (below + p[row][j + 1]) / (dz * dz);
        const double middle = (left + right) / (ds * ds) + 2 * here / (dz * dz);
        p[row][j] += 1.9 * ((sum + std::cos(s)) / middle - p[row][j]);
      }
    }
  Vector2 W = Vector2::Zero();
  for (int i = 1; i < n; ++i) {
    const double s = -pi / 2 + i * ds;
    double sum = 0;
    for (std::size_t j = 0; j < m; ++j) sum += (j == 0 ? 1 : 2) * p[static_cast<std::size_t>(i)][j] * dz;
    W += sum * ds * Vector2(std::cos(s), std::sin(s));
  }
  return 12 / std::pow(2 * slenderness, 3) * W;  // N = 6 mu |B| R/c^3 times the integral, over mu R L^3/(2 c^3) |B|
}

}  // namespace test_journal_bearings

using namespace test_journal_bearings;

// F. W. Ocvirk, NACA TN 2808 (1952).
TEST_CASE("a steady journal in a short bearing has Ocvirk's load and attitude") {
  for (const double eps : eccentricities) {
    CAPTURE(eps);
    const Vector6 N = short_bearing().calc(six(eps * c, 0, 0), six(0, 0, omega)).N;
    const double root = std::sqrt(1 - eps * eps);
    CHECK_THAT(-N[1] / N[0], WithinRel(pi * root / (4 * eps), 1e-7));  // the load is -N; N_y < 0: a forward whirl
    const double load = mu * omega * R * L * L * L / (4 * c * c) * eps / std::pow(root, 4) *
                        std::sqrt(16 * eps * eps + pi * pi * root * root);
    CHECK_THAT(N.norm(), WithinRel(load, 1e-7));
    CHECK_THAT(short_bearing().calc(six(0, -eps * c, 0), six(0, 0, -omega)).N[0], WithinRel(-N[1], 1e-7));
  }
}

// M. I. Friswell, J. E. T. Penny, S. D. Garvey, A. W. Lees, Dynamics of Rotating Machines (2010), section 5.5.
TEST_CASE("a short bearing has the eight published coefficients") {
  for (const double eps : {0.1, 0.5, 0.8}) {
    CAPTURE(eps);
    const BearingLaw::Force force = short_bearing().calc(six(eps * c, 0, 0), six(0, 0, omega));
    const double e2 = eps * eps, root = std::sqrt(1 - e2), p2 = pi * pi;
    const double h = std::pow(p2 * (1 - e2) + 16 * e2, -1.5);
    // u normal to the load, v along it; the bearing turns from u to v.
    Matrix2 a, b;
    a << 4 * (p2 * (2 - e2) + 16 * e2), pi * (p2 * (1 - e2) * (1 - e2) - 16 * e2 * e2) / (eps * root),
        -pi * (p2 * (1 - e2) * (1 + 2 * e2) + 32 * e2 * (1 + e2)) / (eps * root),
        4 * (p2 * (1 - e2) * (1 + 2 * e2) + 32 * e2 * (1 + e2)) / (1 - e2);
    b << 2 * pi * root * (p2 * (1 + 2 * e2) - 16 * e2) / eps, -8 * (p2 * (1 + 2 * e2) - 16 * e2),
        -8 * (p2 * (1 + 2 * e2) - 16 * e2), 2 * pi * (p2 * (1 - e2) * (1 - e2) + 48 * e2) / (eps * root);
    const Vector2 load = force.N.head<2>().normalized();  // the film carries it
    Matrix2 axes;
    axes << Vector2(load.y(), -load.x()), load;
    const Matrix2 K = axes.transpose() * force.by_e.topLeftCorner<2, 2>() * axes;
    const Matrix2 C = axes.transpose() * force.by_v.topLeftCorner<2, 2>() * axes;
    const double size = force.N.norm();
    CHECK((K * c / size - h * a).norm() < 1e-7 * (h * a).norm());
    CHECK((C * c * omega / size - h * b).norm() < 1e-7 * (h * b).norm());
  }
}

TEST_CASE("a squeezed film resists with pi/2 of the centred short bearing, and does not turn") {
  const Vector6 N = short_bearing().calc(Vector6::Zero(), six(1e-3, 0, 0)).N;
  CHECK_THAT(N[0], WithinRel(pi * mu * R * std::pow(L / c, 3) / 2 * 1e-3, 1e-12));
  CHECK_THAT(N[1], WithinAbs(0, 1e-12 * N[0]));
}

TEST_CASE("a long bearing has the pressure of Sommerfeld's half film per length") {
  for (const double eps : {0.3, 0.6, 0.8}) {
    CAPTURE(eps);
    const auto force = [&](double slenderness) {
      return Vector2(std::pow(slenderness, 3) * JournalFilm(slenderness).shape(0, eps).W);
    };
    const Vector2 per_length = (force(8) - force(6)) / 2;  // the ends have the same share of both
    const double e2 = eps * eps, root = std::sqrt(1 - e2);
    // The differences of 128 parts are accurate to the square of their length over that of the peak, 1 - eps.
    CHECK_THAT(per_length[0], WithinRel(3 * pi / ((2 + e2) * root), 3e-3));
    CHECK_THAT(per_length[1], WithinRel(6 * eps / ((2 + e2) * (1 - e2)), 3e-3));
  }
}

TEST_CASE("a bearing of finite length has the pressure of Reynolds' equation in two dimensions") {
  for (const double slenderness : {0.5, 1.0}) {
    const Vector2 expected = relaxed_shape(slenderness, 0.2, 0.5);
    const Vector2 W = JournalFilm(slenderness).shape(0.2, 0.5).W;
    CHECK((W - expected).norm() < 3e-3 * expected.norm());
  }
  const Vector2 narrow = JournalFilm(0.02).shape(0.2, 0.5).W, infinitely = JournalFilm(0).shape(0.2, 0.5).W;
  CHECK((narrow - infinitely).norm() < 2e-3 * infinitely.norm());
}

// At the limit of whirl with the frequency w, det(K - m w^2 + i w C) = 0: with kappa = m w^2 its imaginary and real
// part are
//   kappa (cxx + cyy) = kxx cyy + kyy cxx - kxy cyx - kyx cxy,   w^2 (cxx cyy - cxy cyx) = (kxx - kappa)(kyy - kappa) -
//   kxy kyx
// K and C are the published ones, of the test before.
TEST_CASE("a rigid rotor whirls in short bearings from its critical mass on, at half the speed when it is light") {
  for (const double eps : {0.01, 0.4}) {
    CAPTURE(eps);
    const BearingLaw::Force force = short_bearing().calc(six(eps * c, 0, 0), six(0, 0, omega));
    const Matrix2 k = force.by_e.topLeftCorner<2, 2>(), d = force.by_v.topLeftCorner<2, 2>();
    const double kappa =
        (k(0, 0) * d(1, 1) + k(1, 1) * d(0, 0) - k(0, 1) * d(1, 0) - k(1, 0) * d(0, 1)) / (d(0, 0) + d(1, 1));
    const double whirl = std::sqrt(((k(0, 0) - kappa) * (k(1, 1) - kappa) - k(0, 1) * k(1, 0)) / d.determinant());
    const double critical = kappa / (whirl * whirl);
    if (eps < 0.1) CHECK_THAT(whirl / omega, WithinAbs(0.5, 1e-3));
    const auto growth = [&](double mass) {
      const auto model = model_from_text(fmt::format(
          "nodes: {{rotor: {{position: [0, 0, 0]}}}}\nelements: {{rotor: {{type: rigid_body, node: rotor, mass: {}, "
          "inertia: [1, 1, 1]}}}}\njoints: {{film: {{type: journal_bearing, nodes: [ground, rotor], axis: [0, 0, 1], "
          "diameter: {}, length: {}, clearance: {}, viscosity: {}, model: short}}}}",
          mass, 2 * R, L, c, mu));
      const DenseModel dense(*model);
      State state = dense.start();
      state.nodes[1].x = Vector3(eps * c, 0, 0);
      state.nodes[1].Omega = Vector3(0, 0, omega);
      MatrixX A = MatrixX::Zero(4, 4);
      A.topRightCorner(2, 2).setIdentity();
      A.bottomLeftCorner(2, 2) = -dense.tangent(state, DenseModel::Part::K).block(6, 6, 2, 2) / mass;
      A.bottomRightCorner(2, 2) = -dense.tangent(state, DenseModel::Part::C).block(6, 6, 2, 2) / mass;
      return bielle::test::eigenvalues(A).real().maxCoeff();
    };
    CHECK_THAT(growth(critical) / omega, WithinAbs(0, 1e-7));
    CHECK(growth(0.99 * critical) < 0);
    CHECK(growth(1.01 * critical) > 0);
  }
}

// With K = [[k, q], [-q, k]] and damping c, a forward whirl of the undamped frequency is at its limit at q = c omega_n.
TEST_CASE("cross-coupled stiffness drives a rotor from c omega_n on") {
  const double k = 5e4, m = 2, damping = 30, limit = damping * std::sqrt(k / m);
  const auto growth = [&](const char* type, double q) {
    const bool bushing = std::string(type) == "bushing";
    const std::string keys =
        bushing ? fmt::format(
                      "type: bushing, unsymmetric: true, stiffness: [[{0}, {1}, 0, 0, 0, 0], [-{1}, {0}, 0, 0, 0, "
                      "0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1]], "
                      "damping: [{2}, {2}, 0, 0, 0, 0]",
                      k, q, damping)
                : fmt::format("type: bearing, radial: {{stiffness: [[{0}, {1}], [-{1}, {0}]], damping: {2}}}", k, q,
                              damping);
    const auto model = model_from_text(
        fmt::format("nodes: {{disc: {{position: [0, 0, 0]}}}}\nelements: {{disc: {{type: point_mass, node: disc, mass: "
                    "{}}}}}\njoints: {{film: {{nodes: [ground, disc], axis: [0, 0, 1], {}}}}}",
                    m, keys));
    const DenseModel dense(*model);
    const State state = dense.start();
    const MatrixX K = dense.tangent(state, DenseModel::Part::K).block(6, 6, 2, 2),
                  C = dense.tangent(state, DenseModel::Part::C).block(6, 6, 2, 2);
    MatrixX A = MatrixX::Zero(4, 4);
    A.topRightCorner(2, 2).setIdentity();
    A.bottomLeftCorner(2, 2) = -K / m;
    A.bottomRightCorner(2, 2) = -C / m;
    return bielle::test::eigenvalues(A).real().maxCoeff();
  };
  for (const char* type : {"bearing", "bushing"}) {
    CHECK_THAT(growth(type, limit), WithinAbs(0, 1e-6));
    CHECK(growth(type, 0.999 * limit) < -1e-3);
    CHECK(growth(type, 1.001 * limit) > 1e-3);
  }
}

TEST_CASE("coefficients over the speed of the shaft are those of matrices between the speeds of their table") {
  for (const Eigen::Index n : {2, 5}) {
    Eigen::MatrixXd table(2, FilmCoefficients::columns(n));
    for (Eigen::Index k = 0; k < table.cols(); ++k) table.col(k) << 3 + std::sin(k), 1 - 2 * std::cos(3 * k);
    table.col(0) << 100, 300;
    LinearBearingLaw film, at_150;
    film.film.emplace(n, table, "film.csv");
    for (Eigen::Index row = 0; row < n; ++row)
      for (Eigen::Index column = 0; column < n; ++column) {
        const auto between = [&](Eigen::Index k) { return 0.75 * table(0, k) + 0.25 * table(1, k); };
        at_150.K(row, column) = between(1 + n * row + column);
        at_150.D(row, column) = between(1 + n * n + n * row + column);
      }
    const Vector6 e = (Vector6() << 1, -2, 0.5, 0.3, -0.7, 9).finished(),
                  v = (Vector6() << 0.2, 3, -1, 0.4, 0.1, 150).finished();
    CHECK((film.calc(e, v).N - at_150.calc(e, v).N).norm() < 1e-13);
    CHECK((film.calc(e, v).by_e - at_150.calc(e, v).by_e).norm() < 1e-13);
    // Beyond the table its last row is used.
    Vector6 faster = v;
    faster[5] = 1000;
    CHECK(film.calc(e, faster).by_v.col(5).isZero(0));
    CHECK(std::abs(film.calc(e, faster).by_e(1, 0) - table(1, 1 + n)) < 1e-13);
  }
}
