// Modes of mechanisms in motion: whirl, rotating beams, tops.
#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_rotors {
namespace {

constexpr double Jp = 0.035, Jt = 0.02, mass = 5, k_tilt = 800;

/// Returns a rigid disc on an axle whose massless bearing rests on springs.
std::string rotor(double speed, double kx, double ky, const std::string& more = "") {
  return fmt::format(
      "nodes: {{hub: {{position: [0, 0, 0]}}, disc: {{position: [0, 0, 0], angular_velocity: [0, 0, {0}]}}}}\n"
      "elements:\n  disc: {{type: rigid_body, node: disc, mass: {1}, inertia: [{2}, {2}, {3}]}}\n"
      "joints:\n  mount: {{type: bushing, nodes: [ground, hub], stiffness: [{4}, {5}, 3e5, {6}, {6}, 500]{7}}}\n"
      "  axle: {{type: hinge, nodes: [hub, disc], position: [0, 0, 0], axis: [0, 0, 1]}}\n",
      speed, mass, Jt, Jp, kx, ky, k_tilt, more);
}

}  // namespace

TEST_CASE("a spinning disc tilts forwards and backwards with different frequencies", "[linearised]") {
  // G. Genta, Dynamics of Rotating Systems (2005), ch. 4: Jt w^2 -+ Jp Om w - k = 0. Supports may differ: inertial
  // axes.
  for (const double speed : {0.0, 30.0, 100.0, 1000.0}) {
    const ModesReport report = ModesOf(rotor(speed, 2e5, 1e5))();
    CAPTURE(speed);
    CHECK(report.axes == ModeAxes::inertial);
    if (speed > 0) CHECK(report.steadiness->steady());
    CHECK(count_rigid(report) == 1);
    const double gyro = Jp * speed, root = std::sqrt(gyro * gyro + 4 * k_tilt * Jt);
    std::vector<double> exact = {(root - gyro) / (2 * Jt), (root + gyro) / (2 * Jt), std::sqrt(2e5 / mass),
                                 std::sqrt(1e5 / mass), std::sqrt(3e5 / mass)};
    std::sort(exact.begin(), exact.end());
    check_rates(rates_of(report), exact, 1e-9);
    for (const Mode& mode : report.found.modes) CHECK(std::abs(mode.damping_ratio()) < 1e-9);
  }
}

TEST_CASE("a steady rotation as a whole tells of forces that do not turn with it", "[linearised]") {
  const auto setting = [](const std::string& gravity) {
    const std::string support = "type: bearing, nodes: [ground, disc], axis: [0, 0, 1], radial: {stiffness: 2e5}";
    const ModesOf model(
        fmt::format("gravity: {0}\nnodes: {{disc: {{}}}}\nelements:\n"
                    "  disc: {{type: rigid_body, node: disc, mass: 5, inertia: [0.02, 0.02, 0.035]}}\n"
                    "joints:\n  low: {{{1}, position: [0, 0, -0.1], axial: {{stiffness: 3e5}}}}\n"
                    "  high: {{{1}, position: [0, 0, 0.1]}}\n",
                    gravity, support));
    ModesOptions options;
    options.rotation = SteadyRotation{Vector3(0, 0, 50), Vector3::Zero()};
    return static_cast<LinearisedSetting>(compute_modes(model.session, options));
  };
  CHECK(setting("[0, 0, -9.81]").standing.empty());
  CHECK(setting("[0, 0, 0]").standing.empty());
  const LinearisedSetting across = setting("[3, -4, 0]");  // 5 m/s^2
  CHECK(across.standing == "25 N at node 'disc'");
  CHECK_THAT(format_setting(across, "modes"), Catch::Contains("does (25 N at node 'disc')"));
}

TEST_CASE("a small motion along a mode of a damped rotor goes as exp(s t)", "[linearised]") {
  // The nonlinear model is integrated in time from a state along the mode, with constraints, gyroscopic terms and
  // damping together.
  const std::string text = rotor(60, 2e5, 1e5, ", damping: [200, 100, 100, 0.5, 1, 1]");
  ModesOf model(text);
  const ModesReport report = model();
  const System& system = model.session.system();
  constexpr double size = 1e-5;
  int compared = 0;
  for (const Mode& mode : report.found.modes) {
    if (mode.kind != ModeKind::oscillating) continue;
    const auto at = [&](double t) -> std::complex<double> { return size * std::exp(mode.s * t); };
    State state = report.about.state;
    VectorX v(system.dofs()), a(system.dofs());
    system.get_rates(state, v, a);
    system.displace(state, State(state), (mode.u * at(0)).real().head(system.dofs()));
    system.set_rates(state, v + (mode.w * at(0)).real(), a);
    const double end = two_pi / std::abs(mode.s);
    Session session(model.file.model);
    session.set_state(state);
    DynamicsOptions options;
    options.duration = end;
    options.stepping.size = end / 4000;
    options.scheme = Scheme::generalized_alpha(1);
    options.newton.tolerance = 1e-11;
    session.dynamics(options).finish();
    const int hub = *model.file.model.find_node("hub");
    const NodeShapes shapes = node_shapes(system, report.about.state, mode);
    const NodeState& node = session.state().nodes[static_cast<std::size_t>(hub)];
    const Vector3 moved = (shapes.displacement.col(hub) * at(end)).real(),
                  turned = (shapes.rotation.col(hub) * at(end)).real();
    CAPTURE(mode.s);
    // Errors of the steps are (2 pi/4000)^2 2 pi/12, those of linearisation 1e-5.
    const double whole = size * std::abs(std::exp(mode.s * end));
    CHECK((node.x - moved).norm() < 2e-4 * whole);
    CHECK((log_so3(node.R) - turned).norm() < 2e-4 * whole);
    ++compared;
  }
  CHECK(compared == 5);
}

TEST_CASE("a rotating cantilever has Wright's frequencies, in and out of the plane", "[linearised]") {
  // A. Wright, C. Smith, R. Thresher, J. Wang, J. Appl. Mech. 49 (1982) 197 (tests/references/rotating_beam.py): flap;
  // lag is less by the speed's square. EI = m = L = 1.
  const auto text = [](double eta, double hub) {
    return fmt::format(
        "nodes: {{root: {{position: [{1}, 0, 0], motion: {{x: \"{1}*(cos({0}*t) - 1)\", y: \"{1}*sin({0}*t)\", z: 0, "
        "rx: 0, ry: 0, rz: "
        "\"{0}*t\"}}}}, tip: {{position: [{1} + 1, 0, 0]}}}}\n"
        "elements:\n  b: {{type: beam, nodes: [root, tip], elements: 16, orientation: [0, 1, 0], section: {{EA: 1e7, "
        "GAy: 1e7, GAz: "
        "1e7, GJ: 1, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 1e-7, Jy: 1e-7, Jz: 1e-7}}}}\n",
        eta, hub);
  };
  struct Case {
    double eta, hub, flap, second_flap;
  };
  const bielle::test::ReferenceTable exact("rotating_beam");
  for (const Case& each :
       {Case{1, 0, exact("1.flap_1"), exact("1.flap_2")}, Case{6, 0, exact("6.flap_1"), exact("6.flap_2")},
        Case{12, 0, exact("12.flap_1"), exact("12.flap_2")}, Case{12, 1, exact("12.hub.flap_1"), 0}}) {
    const ModesOf model(text(each.eta, each.hub));
    const SteadyRotation rotation{Vector3(0, 0, each.eta), Vector3::Zero()};
    const ModesReport report = compute_modes(model.session, {{.count = 4}, rotation});
    CAPTURE(each.eta);
    CHECK(report.axes == ModeAxes::turning);
    CHECK(report.steadiness->steady());
    const double lag = std::sqrt(each.flap * each.flap - each.eta * each.eta);
    const std::vector<double> found = rates_of(report);
    // Frequencies of 16 elements at rest are accurate to 1e-5. Large tension is carried by elements with constant
    // strain.
    CHECK(found[0] == Approx(lag).epsilon(1e-3));
    CHECK(found[1] == Approx(each.flap).epsilon(1e-3));
    if (each.second_flap > 0) {
      const double second_lag = std::sqrt(std::pow(each.second_flap, 2) - each.eta * each.eta);
      CHECK(found[2] == Approx(second_lag).epsilon(2e-3));
      CHECK(found[3] == Approx(each.second_flap).epsilon(2e-3));
    }
  }
}

TEST_CASE("a rigid blade on a flapping hinge in rotation swings with the speed", "[linearised]") {
  // Flap of a rod hinged in the axis: omega = Om; hinged at e outside it: Om sqrt(1 + 3 e/(2 l)). Only centrifugal
  // forces act.
  for (const double e : {0.0, 0.2}) {
    const double rate = 7;
    const ModesOf model(
        fmt::format("nodes: {{hub: {{position: [0, 0, 0], motion: {{x: 0, y: 0, z: 0, rx: 0, ry: 0, rz: \"{0}*t\"}}}}, "
                    "rod: {{position: [{1} + 0.5, "
                    "0, 0]}}}}\n"
                    "elements: {{rod: {{type: rigid_body, node: rod, mass: 3, inertia: [0, 0.25, 0.25]}}}}\n"
                    "joints: {{flap: {{type: hinge, nodes: [hub, rod], position: [{1}, 0, 0], axis: [0, 1, 0]}}}}\n",
                    rate, e));
    const ModesReport report = compute_modes(model.session, {{}, SteadyRotation{Vector3(0, 0, rate), Vector3::Zero()}});
    CHECK(report.steadiness->steady());
    CHECK(report.standing.empty());
    check_rates(rates_of(report), {rate * std::sqrt(1 + 1.5 * e)}, 1e-9);
  }
}

TEST_CASE("a free body spins stably about its largest and smallest inertia, not about the middle one", "[linearised]") {
  // L. Euler: s^2 = -Om^2 (J_a - J_s)(J_b - J_s) / (J_a J_b) with signs of the spin axis s, in axes of the body.
  const Vector3 J(1, 2, 2.5);
  for (int axis = 0; axis < 3; ++axis) {
    Vector3 spin = Vector3::Zero();
    spin[axis] = 4;
    const ModesReport report =
        ModesOf(fmt::format("nodes: {{b: {{position: [0, 0, 0], fixed: [x, y, z], angular_velocity: [{}, {}, {}]}}}}\n"
                            "elements: {{b: {{type: rigid_body, node: b, mass: 1, inertia: [1, 2, 2.5]}}}}\n",
                            spin[0], spin[1], spin[2]))();
    const double Js = J[axis], Ja = J[(axis + 1) % 3], Jb = J[(axis + 2) % 3];
    const double square = -16 * (Js - Ja) * (Js - Jb) / (Ja * Jb);
    CAPTURE(axis);
    CHECK(report.axes == ModeAxes::turning);
    CHECK(report.steadiness->steady());
    bool found = false, grows = false;
    for (const Mode& mode : report.found.modes) {
      if (mode.kind != ModeKind::rigid && std::abs(mode.s * mode.s - square) < 1e-9 * std::abs(square)) found = true;
      if (mode.kind == ModeKind::growing) grows = true;
    }
    CHECK(found);
    CHECK(grows == (axis == 1));
  }
}

TEST_CASE("what does not turn as a whole is refused, and a motion that is not steady is told", "[linearised]") {
  const std::string blade =
      "nodes: {root: {position: [0, 0, 0], fixed: true}, b: {position: [1, 0, 0]}}\n"
      "elements: {b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}}\n"
      "joints: {j: {type: rigid, nodes: [root, b]}}\n";
  const ModesOf model(blade);
  CHECK_THROWS_WITH(compute_modes(model.session, {{}, SteadyRotation{Vector3(0, 0, 3), Vector3::Zero()}}),
                    Catch::Contains("cannot turn as a whole") && Catch::Contains("joint 'j'"));
  const ModesReport falling = ModesOf(
      "gravity: [0, 0, -9.81]\nnodes: {b: {position: [1, 0, 0], angular_velocity: [0, 3, 0]}}\n"
      "elements: {b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}}\n"
      "joints: {j: {type: hinge, nodes: [ground, b], position: [0, 0, 0], axis: [0, 1, 0]}}\n")();
  REQUIRE(falling.steadiness);
  CHECK_FALSE(falling.steadiness->steady());
}

TEST_CASE("a swept blade finds its steady rotation at every speed, whatever its elements", "[linearised]") {
  // The blade turns towards the radius through its root: its tip moves outwards and its sweep goes down as the speed
  // goes up, steadily, and the equilibrium is a minimum of elastic energy and the potential of inertia: nothing grows.
  // Elements of any length resist sideways displacement under tension: four of them are accurate to 3 % (if they were
  // as soft as shear, the condensed part of bending would lose three quarters of the first frequency at 200 rad/s).
  struct Found {
    Vector3 tip;
    double frequency;
  };
  const auto found = [](double speed, int elements) {
    const ModesOf model(fmt::format(
        "gravity: [0, 0, 0]\nnodes:\n  hub: {{position: [0.1, 0, 0], motion: {{x: \"0.1*(cos({0}*t) - 1)\", y: "
        "\"0.1*sin({0}*t)\", z: 0, rx: 0, ry: 0, rz: \"{0}*t\"}}}}\n"
        "  tip: {{position: [\"0.1 + cos(0.3)\", \"sin(0.3)\", 0]}}\n"
        "elements: {{blade: {{type: beam, nodes: [hub, tip], elements: {1}, orientation: [0, 0, 1], section: "
        "{{rectangle: "
        "[0.03, 0.005], young: 7e10, poisson: 0.3, density: 2700}}}}}}\n",
        speed, elements));
    ModesOptions options;
    options.search.count = 2;
    options.rotation = SteadyRotation{{0, 0, speed}, {0, 0, 0}};
    const ModesReport report = compute_modes(model.session, options);
    CHECK(count_rigid(report) == 0);
    for (const Mode& mode : report.found.modes) CHECK(mode.kind == ModeKind::oscillating);
    return Found{report.about.state.nodes[2].x, report.found.modes.front().frequency()};
  };
  double radius = std::hypot(0.1 + std::cos(0.3), std::sin(0.3)), sweep = std::sin(0.3);
  for (const double speed : {20.0, 60.0, 100.0, 200.0, 300.0}) {
    CAPTURE(speed);
    const Found by_four = found(speed, 4), by_eight = found(speed, 8), by_sixteen = found(speed, 16);
    CHECK_THAT(by_eight.frequency, Catch::WithinRel(by_sixteen.frequency, 0.01));
    if (speed <= 200) CHECK_THAT(by_four.frequency, Catch::WithinRel(by_sixteen.frequency, 0.03));
    const Vector3 coarse = by_four.tip, middle = by_eight.tip, fine = by_sixteen.tip;
    CHECK(fine.norm() > radius);
    CHECK(fine.y() < sweep);
    CHECK(fine.y() > 0);
    radius = fine.norm();
    sweep = fine.y();
    // Convergence is of second order at least if elements are shorter than the length that bends at the root,
    // (EI/T)^1/2 = 0.1 m at 100 rad/s.
    CHECK((fine - middle).norm() < (speed <= 100 ? 0.3 : 1.0) * (middle - coarse).norm());
  }
}

}  // namespace test_rotors
