// Oil whirl: the speed at which a rigid rotor on two journal bearings becomes unstable, by its exponents and in time.
//
// With the coefficients k (c/W times the stiffness) and d (c omega/W times the damping) of the film, a mass m that
// loads it by W = m g is at its limit at the whirl frequency w if
//     kappa = (kxx dyy + kyy dxx - kxy dyx - kyx dxy)/(dxx + dyy),  m c w^2/W = kappa,
//     (w/omega)^2 = ((kxx - kappa) (kyy - kappa) - kxy kyx)/(dxx dyy - dxy dyx),
// so that the speed is omega = sqrt(kappa g/c)/(w/omega) (J. W. Lund, The stability of an elastic rotor in journal
// bearings with flexible, damped supports, J. Appl. Mech. 32 (1965) 911).
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/benchmarks/linearised/modes_of.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_oil_whirl {
namespace {

using std::numbers::pi;
constexpr double g = 9.81, mass = 16, diameter = 0.04, c = 4e-5, span = 0.4, short_length = 0.016;

struct Limit {
  double kappa, ratio_squared;
  double ratio() const { return std::sqrt(ratio_squared); }
  double speed() const { return std::sqrt(kappa * g / c) / ratio(); }
};

Limit limit_of(const Matrix2& k, const Matrix2& d) {
  const double kappa =
      (k(0, 0) * d(1, 1) + k(1, 1) * d(0, 0) - k(0, 1) * d(1, 0) - k(1, 0) * d(0, 1)) / (d(0, 0) + d(1, 1));
  return {kappa, ((k(0, 0) - kappa) * (k(1, 1) - kappa) - k(0, 1) * k(1, 0)) / d.determinant()};
}

/// M. I. Friswell, J. E. T. Penny, S. D. Garvey, A. W. Lees, Dynamics of Rotating Machines (2010), section 5.5.
Limit short_limit(double eps) {
  const double e2 = eps * eps, root = std::sqrt(1 - e2), p2 = pi * pi, h = std::pow(p2 * (1 - e2) + 16 * e2, -1.5);
  Matrix2 k, d;
  k << 4 * (p2 * (2 - e2) + 16 * e2), pi * (p2 * (1 - e2) * (1 - e2) - 16 * e2 * e2) / (eps * root),
      -pi * (p2 * (1 - e2) * (1 + 2 * e2) + 32 * e2 * (1 + e2)) / (eps * root),
      4 * (p2 * (1 - e2) * (1 + 2 * e2) + 32 * e2 * (1 + e2)) / (1 - e2);
  d << 2 * pi * root * (p2 * (1 + 2 * e2) - 16 * e2) / eps, -8 * (p2 * (1 + 2 * e2) - 16 * e2),
      -8 * (p2 * (1 + 2 * e2) - 16 * e2), 2 * pi * (p2 * (1 - e2) * (1 - e2) + 48 * e2) / (eps * root);
  return limit_of(h * k, h * d);
}

/// Ocvirk's load over mu omega R L^3/(4 c^2).
double short_load(double eps) {
  const double root = std::sqrt(1 - eps * eps);
  return eps / std::pow(root, 4) * std::sqrt(16 * eps * eps + pi * pi * root * root);
}
double short_attitude(double eps) { return std::atan2(pi * std::sqrt(1 - eps * eps), 4 * eps); }

/// A journal at rest of its centre in turning oil.
struct Film {
  const char* model;
  double length, viscosity, eps, attitude;
};

double short_viscosity(double length, double speed, double eps) {
  return mass * g / 2 / (speed * diameter / 2 * std::pow(length, 3) / (4 * c * c) * short_load(eps));
}

/// Returns the film of a short bearing of this viscosity under half of the weight.
Film short_film(double length, double viscosity, double speed) {
  double low = 1e-9, high = 1 - 1e-9;
  while (high - low > 1e-15) {
    const double middle = (low + high) / 2;
    (short_viscosity(length, speed, middle) > viscosity ? low : high) = middle;
  }
  return {"short", length, viscosity, low, short_attitude(low)};
}

/// The rotor has no gyroscopic moments, which would make it tilt sooner than it whirls.
/// @param push  velocity of the rotor along x [m/s]
std::string rotor(const Film& film, double speed, double push = 0) {
  const double at = film.attitude - pi / 2;  // the load acts along -y
  std::string text = fmt::format(
      "gravity: [0, -{}, 0]\n"
      "nodes: {{rotor: {{position: [{:.17g}, {:.17g}, 0], velocity: [{:.17g}, 0, 0], angular_velocity: [0, 0, "
      "{:.17g}]}}}}\n"
      "elements: {{rotor: {{type: rigid_body, node: rotor, mass: {}, inertia: [0.3, 0.3, 1e-6]}}}}\njoints:\n",
      g, film.eps * c * std::cos(at), film.eps * c * std::sin(at), push, speed, mass);
  for (const int side : {-1, 1})
    text += fmt::format(
        "  {}: {{type: journal_bearing, nodes: [ground, rotor], at: [[0, 0, {:.17g}], [0, 0, {:.17g}]], axis: [0, 0, "
        "1], diameter: {}, length: {}, clearance: {}, viscosity: {:.17g}, model: {}}}\n",
        side < 0 ? "left" : "right", side * span / 2, side * span / 2, diameter, film.length, c, film.viscosity,
        film.model);
  text += fmt::format(
      "  thrust: {{type: bearing, nodes: [ground, rotor], at: [[0, 0, 0], [0, 0, 0]], axis: [0, 0, 1], radial: 0, "
      "axial: {{stiffness: 1e6, damping: 500}}}}\n"
      "drives: {{motor: {{joint: thrust, coordinate: angle, rate: {:.17g}}}}}\n",
      speed);
  return text;
}

/// Returns the exponent with the largest real part; the state has to be at rest but for the rotation.
std::complex<double> fastest_growth(const Film& film, double speed) {
  const ModesOf model(rotor(film, speed));
  const ModesReport report = model();
  CHECK(report.axes == ModeAxes::inertial);
  REQUIRE(report.steadiness);
  CHECK(report.steadiness->steady_in(ModeAxes::inertial));
  CHECK(report.about.state.nodes[1].a.norm() < 2e-3 * g);
  std::complex<double> fastest = -1e9;
  for (const Mode& mode : report.found.modes)
    if (mode.kind != ModeKind::rigid && mode.s.real() > fastest.real()) fastest = mode.s;
  return fastest;
}

}  // namespace

TEST_CASE("a rotor in short bearings whirls from its limit speed on, at its whirl frequency", "[linearised]") {
  for (const double eps : {0.1, 0.3, 0.5, 0.7}) {
    CAPTURE(eps);
    const Limit limit = short_limit(eps);
    const double viscosity = short_viscosity(short_length, limit.speed(), eps);
    const auto growth = [&](double speed) { return fastest_growth(short_film(short_length, viscosity, speed), speed); };
    double below = 0.8 * limit.speed(), above = 1.2 * limit.speed();
    REQUIRE(growth(below).real() < 0);
    REQUIRE(growth(above).real() > 0);
    while (above - below > 1e-9 * limit.speed()) {
      const double middle = (below + above) / 2;
      (growth(middle).real() < 0 ? below : above) = middle;
    }
    CHECK(above / limit.speed() == Approx(1).epsilon(1e-6));
    CHECK(growth(above).imag() / above == Approx(limit.ratio()).epsilon(1e-6));
  }
}

TEST_CASE("a rotor deep in its short bearings is stable at any speed", "[linearised]") {
  // (w/omega)^2 is zero at the eccentricity 0.756.
  CHECK(short_limit(0.755).ratio_squared > 0);
  CHECK(short_limit(0.757).ratio_squared < 0);
  for (const double eps : {0.74, 0.77})
    for (const double times : {1.0, 3.0, 10.0, 30.0}) {
      const double speed = times * std::sqrt(g / c);
      const Film film{"short", short_length, short_viscosity(short_length, speed, eps), eps, short_attitude(eps)};
      CAPTURE(eps, times);
      const bool stable = fastest_growth(film, speed).real() < 0;
      CHECK(stable == (eps > 0.756 || speed < short_limit(eps).speed()));
    }
}

TEST_CASE("a rotor in bearings of finite length whirls from the limit of their coefficients on", "[linearised]") {
  const ReferenceTable table("journal_film");
  struct Condition {
    const char *rows, *model;
    std::vector<double> slendernesses;
    double known;  // the coefficients, and with them the growth at the limit
  };
  for (const Condition& condition : {Condition{"half", "finite", {1.0, 0.5, 0.25}, 1e-3},
                                     Condition{"reynolds", "finite, cavitation: reynolds", {1.0, 0.5}, 5e-3}})
    for (const double slenderness : condition.slendernesses) {
      constexpr double eps = 0.4;
      CAPTURE(condition.rows, slenderness);
      const std::string name = fmt::format("{}.{}.{}", condition.rows, slenderness, eps);
      const auto coefficients = [&](const char* kind) {
        Matrix2 matrix;
        for (const int row : {0, 1})
          for (const int column : {0, 1})
            matrix(row, column) = table(fmt::format("{}.{}_{}{}", name, kind, "xy"[row], "xy"[column]));
        return matrix;
      };
      const Limit limit = limit_of(coefficients("stiffness"), coefficients("damping"));
      const double length = slenderness * diameter, speed = limit.speed();
      const double viscosity =
          mass * g / 2 / (table(name + ".load") * speed * diameter * length * std::pow(diameter / 2 / c, 2));
      const Film film{condition.model, length, viscosity, eps, table(name + ".angle") * pi / 180};
      const std::complex<double> s = fastest_growth(film, speed);
      CHECK(s.imag() / speed == Approx(limit.ratio()).epsilon(condition.known));
      CHECK(std::abs(s.real()) < condition.known * s.imag());
    }
}

TEST_CASE("below the limit of whirl a disturbance decays with the rate of the exponent, and above it grows",
          "[linearised]") {
  constexpr double eps = 0.3;
  const Limit limit = short_limit(eps);
  const double viscosity = short_viscosity(short_length, limit.speed(), eps);
  for (const double times : {0.97, 0.995, 1.005, 1.03}) {
    CAPTURE(times);
    const double speed = times * limit.speed();
    const Film film = short_film(short_length, viscosity, speed);
    const std::complex<double> s = fastest_growth(film, speed);
    CHECK((s.real() > 0) == (times > 1));
    // With samples x_k of Re(a exp(s t)) after equal times, x_(k+1) + x_(k-1) exp(2 Re s h) = 2 exp(Re s h) cos(Im s h)
    // x_k.
    constexpr int steps = 256, sampled = 16, turns = 30, settled = 5;
    const double period = two_pi / s.imag();
    Session session = session_of(rotor(film, speed, 1e-4 * c * speed));
    Motion motion = session.dynamics(steps_of(turns * period, period / steps));
    const double rest = film.eps * c * std::cos(film.attitude - pi / 2);
    std::vector<double> x;
    for (long k = 0; motion.step(); ++k)
      if (k % sampled == 0 && k > settled * steps) x.push_back(session.node("rotor").x[0] - rest);
    const auto n = static_cast<Eigen::Index>(x.size());
    REQUIRE(n > 300);
    const Eigen::Map<const VectorX> samples(x.data(), n);
    Eigen::MatrixXd known(n - 2, 2);
    known << samples.segment(1, n - 2), samples.head(n - 2);
    const Eigen::Vector2d found = (known.transpose() * known).ldlt().solve(known.transpose() * samples.tail(n - 2));
    const double h = period * sampled / steps, rate = std::log(-found[1]) / (2 * h),
                 frequency = std::acos(found[0] / 2 / std::sqrt(-found[1])) / h;
    // The error of the scheme is (Im s h)^2/12 = 5e-5 of the exponent, h being a step.
    CHECK(std::abs(frequency - s.imag()) < 1e-4 * s.imag());
    CHECK(std::abs(rate - s.real()) < 1e-5 * s.imag());
    CHECK(rate == Approx(s.real()).epsilon(1e-2));
  }
}

}  // namespace test_oil_whirl
