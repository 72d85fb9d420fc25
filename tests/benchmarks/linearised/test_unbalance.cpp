// An eccentric disk on an elastic bearing in steady rotation (Jeffcott's rotor): its deflection, its whirl, and its
// stability, below, near and above its critical speed.
//
// Mass m with its centre at e from the shaft, moment of inertia J about the centre, stiffness k, w^2 = k/m. In axes
// that turn with Om, with the shaft at r + x + i y and the disk ahead by phi:
//     (w^2 - Om^2) r = e Om^2,
//     x'' - 2 Om y' + (w^2 - Om^2) x - 2 e Om phi' = 0,
//     y'' + 2 Om x' + (w^2 - Om^2) y + e (phi'' - Om^2 phi) = 0,
//     J/m phi'' + w^2 e r phi - w^2 e y = 0,
// whose eigenvalues are s^2 = 0 (the shaft turns as a whole) and the roots S = s^2 of, with j = J/m, g = w^2 - Om^2,
// b = w^2 e^2 and a = b Om^2/g,
//     j S^2 + (a + b + 2 j (w^2 + Om^2)) S + j g^2 + 2 a (w^2 + Om^2) + b (w^2 + 2 Om^2) = 0.
// A shaft that turns freely is thus unstable from the critical speed to the speed at which the last term vanishes.
#include "mechanism/analyses/modes.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_unbalance {
namespace {

constexpr double m = 10, J = 0.2, Jt = 0.1, k = 1e6, k_tilt = 1e4;

std::string disk(double e, const std::string& radial = "1e6") {
  return fmt::format(
      "nodes: {{d: {{position: [0, 0, 1]}}}}\n"
      "elements: {{d: {{type: rigid_body, node: d, mass: {}, inertia: [{}, {}, {}], centre: [{:.17g}, 0, 0]}}}}\n"
      "joints: {{b: {{type: bearing, nodes: [ground, d], position: [0, 0, 1], axis: [0, 0, 1], radial: {}, axial: "
      "1e6, tilting: {}}}}}\n",
      m, Jt, Jt, J, e, radial, k_tilt);
}

ModesReport modes_at(double e, double speed) {
  ModesOptions options;
  options.rotation = SteadyRotation{Vector3(0, 0, speed), Vector3::Zero()};
  const ModesOf model(disk(e));
  return compute_modes(model.session, options);
}

/// Returns S of the motions in the plane.
std::array<std::complex<double>, 2> in_plane(double e, double speed) {
  const double w2 = k / m, O2 = speed * speed, g = w2 - O2, j = J / m, b = w2 * e * e, a = b * O2 / g;
  const double half = (a + b + 2 * j * (w2 + O2)) / (2 * j);
  const double last = (j * g * g + 2 * a * (w2 + O2) + b * (w2 + 2 * O2)) / j;
  const std::complex<double> root = std::sqrt(std::complex<double>(half * half - last));
  return {-last / (half + root), -half - root};
}

bool any_grows(const ModesReport& report) {
  return std::any_of(report.found.modes.begin(), report.found.modes.end(),
                     [](const Mode& mode) { return mode.kind == ModeKind::growing; });
}

/// Returns a mode's s^2 nearest to S, relative to it.
double gap(const ModesReport& report, std::complex<double> S) {
  double least = INFINITY;
  for (const Mode& mode : report.found.modes)
    if (mode.kind != ModeKind::rigid) least = std::min(least, std::abs(mode.s * mode.s - S) / std::abs(S));
  return least;
}

}  // namespace

TEST_CASE("an eccentric disk that turns freely finds its radius below, near and above the critical speed",
          "[linearised]") {
  struct Case {
    double e, speed;
  };
  for (const Case& each : {Case{0.1, 1}, Case{0.1, 100}, Case{0.1, 220}, Case{1e-3, 100}, Case{1e-3, 310},
                           Case{1e-4, 316}, Case{1e-4, 317}, Case{1e-4, 400}, Case{1e-3, 400}, Case{0.1, 400},
                           Case{0.1, 1000}, Case{0, 250}, Case{1e-9, 250}, Case{-0.1, 220}}) {
    CAPTURE(each.e, each.speed);
    const ModesReport report = modes_at(each.e, each.speed);
    const NodeState& node = report.about.state.nodes[1];
    CHECK(count_rigid(report) == 1);
    const double square = each.speed * each.speed;
    const Vector3 ahead = node.R.col(0);
    const double radius = each.e * square / (k / m - square);
    CHECK(Vector3(node.x - Vector3(0, 0, 1) - radius * ahead).norm() < 1e-9 * std::max(1e-3, std::abs(radius)));
    CHECK(std::abs(ahead.z()) < 1e-9);
    // The disk moves outwards along two directions at once. It may also tilt outwards if its centre is inside.
    const double tilt = k_tilt + (J - Jt) * square + m * square * (radius + each.e) * each.e;
    CHECK(report.outweighed == (square > k / m ? 2 : 0) + (tilt < 0 ? 1 : 0));
  }
}

TEST_CASE("an eccentric disk that turns freely whirls and stays as its linear equations say", "[linearised]") {
  struct Case {
    double e, speed;
  };
  for (const Case& each : {Case{0.1, 100}, Case{0.1, 220}, Case{1e-2, 300}, Case{1e-3, 310}, Case{1e-3, 319},
                           Case{1e-3, 335}, Case{1e-2, 400}, Case{1e-3, 400}, Case{1e-4, 400}, Case{1e-4, 317.5}}) {
    CAPTURE(each.e, each.speed);
    const ModesReport report = modes_at(each.e, each.speed);
    REQUIRE(report.steadiness);
    CHECK(report.steadiness->steady());
    const auto S = in_plane(each.e, each.speed);
    CAPTURE(S[0], S[1]);
    bool grows = false;
    for (const std::complex<double> each_S : S) grows = grows || each_S.imag() != 0 || each_S.real() > 0;
    CHECK(any_grows(report) == grows);
    CHECK(report.axes == ModeAxes::turning);
    for (const std::complex<double> each_S : S) CHECK(gap(report, each_S) < 1e-6);
  }
}

TEST_CASE("a balanced disk has the inertial whirl frequencies, and a slightly unbalanced one the same in its axes",
          "[linearised]") {
  // The frequencies are sqrt(k/m) in radial directions, and those of tilting, Jt w^2 -+ J Om w - k_t = 0 (G. Genta,
  // Dynamics of Rotating Systems, 2005, ch. 4).
  for (const double speed : {100.0, 400.0}) {
    CAPTURE(speed);
    const ModesReport balanced = modes_at(0, speed);
    CHECK(balanced.axes == ModeAxes::inertial);
    CHECK_FALSE(any_grows(balanced));
    const double gyro = J * speed, root = std::sqrt(gyro * gyro + 4 * Jt * k_tilt);
    const double radial = std::sqrt(k / m), backward = (root - gyro) / (2 * Jt), forward = (root + gyro) / (2 * Jt);
    std::vector<double> exact = {radial, radial, std::sqrt(1e6 / m), backward, forward};
    std::sort(exact.begin(), exact.end());
    check_rates(rates_of(balanced), exact, 1e-9);
    const ModesReport slightly = modes_at(1e-5, speed);
    CHECK_FALSE(any_grows(slightly));
    // In turning axes s = i (w -+ Om), which is lower for forward modes and higher for backward ones.
    CHECK(slightly.axes == ModeAxes::turning);
    std::vector<double> seen = {std::abs(radial - speed), radial + speed, std::sqrt(1e6 / m), backward + speed,
                                std::abs(forward - speed)};
    std::sort(seen.begin(), seen.end());
    check_rates(rates_of(slightly), seen, 1e-4);
  }
}

}  // namespace test_unbalance
