// Parts of cylinders against closed forms: stages, cushions, stops, trapped oil, stiff chambers; and how runs go on.
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/hydraulics/actuators/chamber_space.hpp"
#include "tests/benchmarks/hydraulics/hydraulic_runs.hpp"
#include "tests/support/dense_model.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_cylinder_parts {
namespace {

constexpr double p_a = 101325, g = 9.81;

/// Returns a mass along z, on a cylinder. @param cylinder  keys of the cylinder; @param position  position of the mass
/// [m]
std::string lifted(double mass, double position, const std::string& cylinder, const std::string& more = "",
                   double gravity = g) {
  return fmt::format(
      "gravity: [0, 0, {}]\nnodes:\n  mass: {{position: [0, 0, {}], fixed: [x, y, rx, ry, rz]}}\n"
      "elements:\n  load: {{type: point_mass, node: mass, mass: {}}}\n"
      "  jack: {{type: hydraulic_actuator, nodes: [ground, mass], {}}}\n{}",
      -gravity, position, mass, cylinder, more);
}

double number(const Session& session, const std::string& dataset, std::size_t k = 0) {
  return session.read(dataset)[k];
}

/// Returns the finite eigenvalues of K + s C + s^2 M over some unknowns.
std::vector<std::complex<double>> eigenvalues(const MatrixX& K, const MatrixX& C, const MatrixX& M) {
  const Eigen::Index n = K.rows();
  MatrixX A = MatrixX::Zero(2 * n, 2 * n), E = A;
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -K;
  A.bottomRightCorner(n, n) = -C;
  E.topLeftCorner(n, n).setIdentity();
  E.bottomRightCorner(n, n) = M;
  const Eigen::GeneralizedEigenSolver<MatrixX> solver(A, E, false);
  std::vector<std::complex<double>> finite;
  for (Eigen::Index k = 0; k < 2 * n; ++k)
    if (std::abs(solver.betas()[k]) > 1e-12 * std::abs(solver.alphas()[k]))
      finite.push_back(solver.alphas()[k] / solver.betas()[k]);
  return finite;
}

}  // namespace

TEST_CASE("stiffness, damping and mass of a cylinder give the frequency of its trapped oil") {
  // m s^2 + c s + k = 0, k = B (A_1^2/V_1 + A_2^2/V_2) + (p_1 A_1 - p_2 A_2 balance the load: no part of their own).
  constexpr double m = 500, c = 4e3, B = 1.4e9, A1 = 2e-3, A2 = 1.2e-3;
  const std::string text = lifted(m, 1.25,
                                  "ambient_pressure: 0, bulk_modulus: 1.4e9, piston_areas: [2e-3, 1.2e-3], "
                                  "dead_volumes: [5e-4, 4e-4], stroke: [1, 1.5], pressures: [6e6, 10e6], friction: "
                                  "{viscous: 4000}",
                                  "", 0);
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = options.stepping.size = 1e-3;
  const Motion motion = session.dynamics(options);
  DenseModel dense(file.model);
  std::vector<int> free;
  for (int k = 0; k < dense.nodes(); ++k)
    if (file.model.node(k).name == "mass") free.push_back(6 * k + 2);
  for (int k = dense.first_order_begin(); k < dense.multiplier_begin(); ++k) free.push_back(k);
  REQUIRE(free.size() == 7);  // z, and fluid, pressure and space of two chambers
  // Units in which all unknowns are of order one: m, Pa, m^3.
  VectorX unit = VectorX::Ones(7);
  for (int k = 0; k < 2; ++k) unit.segment<3>(1 + 3 * k) << 1e-3, 1e9, 1e-3;
  const auto part = [&](DenseModel::Part which) {
    const MatrixX all = dense.tangent(motion.state(), which);
    MatrixX some(7, 7);
    for (int i = 0; i < 7; ++i)
      for (int j = 0; j < 7; ++j) some(i, j) = all(free[i], free[j]) * unit[j];
    return some;
  };
  MatrixX K = part(DenseModel::Part::K), C = part(DenseModel::Part::C), M = part(DenseModel::Part::M);
  for (int i = 0; i < 7; ++i) {
    const double largest = std::max(K.row(i).cwiseAbs().maxCoeff(), C.row(i).cwiseAbs().maxCoeff());
    for (MatrixX* matrix : {&K, &C, &M}) matrix->row(i) /= largest;
  }
  constexpr double V1 = 5e-4 + A1 * 0.25, V2 = 4e-4 + A2 * 0.25;
  const double k = B * (A1 * A1 / V1 + A2 * A2 / V2), decay = c / (2 * m), frequency = std::sqrt(k / m - decay * decay);
  int found = 0, still = 0;
  for (const std::complex<double> s : eigenvalues(K, C, M)) {
    if (std::abs(s) < 1e-3) {
      ++still;  // the amount of fluid in each chamber is constant
    } else {
      CHECK(s.real() == Approx(-decay).epsilon(1e-7));
      CHECK(std::abs(s.imag()) == Approx(frequency).epsilon(1e-9));
      ++found;
    }
  }
  CHECK(found == 2);
  CHECK(still == 2);
}

TEST_CASE("a telescopic cylinder extends stage after stage, each with its speed and pressure") {
  constexpr double m = 500, c = 2e4, Q = 2e-4;
  const std::string text =
      lifted(m, 1.0,
             "stages: [{piston_areas: [4e-3], length: 0.3}, {piston_areas: [2e-3], length: 0.3}], stroke: [1, 1.6], "
             "ports: [room], friction: {viscous: 2e4}",
             "hydraulics:\n  volumes: {room: {volume: 1e-4}}\n  supplies: {pump: {to: room, flow: \"2e-4*step(t, 0, "
             "0.5)\"}}\n");
  run_hydraulics(text, {.h = 1e-2, .end = 8.5, .rho = 0.6}, [&](const Session& session) {
    const double t = session.time(), l = number(session, "elements/jack/length");
    const bool first = t > 1 && l<1.29, second = l> 1.33;
    if (!first && !second) return;
    const double A = first ? 4e-3 : 2e-3, v = Q / A;
    CAPTURE(t, l);
    CHECK(number(session, "elements/jack/rate") == Approx(v).epsilon(2e-3));
    CHECK(number(session, "elements/jack/pressure") - p_a == Approx((m * g + c * v) / A).epsilon(2e-3));
    // The pumped fluid occupies its volume, less its compression.
    const double space = first ? 4e-3 * (l - 1) : 4e-3 * 0.3 + 2e-3 * (l - 1.3);
    CHECK(space == Approx(Q * (t - 0.25)).epsilon(4e-3));
  });
}

TEST_CASE("a cushion slows a piston down as its orifice says, and lets it out freely") {
  // The piston is light and driven by constant pressure: A_2 v = C_d A(x) sqrt(2 (p_2 - p_port)/rho), and p_2 A_2 = p_1
  // A_1 during the stroke.
  constexpr double A1 = 2e-3, A2 = 1.2e-3, length = 0.1, port_area = 1e-4, narrow = 2e-6;
  const std::string own =
      "ambient_pressure: 0, supply: {pressure: 1e7, tank: 0}, valve: {area: 1e-4, command: \"if(t < 1, 1, -1)\"}, ";
  const std::string text = lifted(
      1, 1.2,
      own +
          "piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-5, 1e-5], stroke: [1, 1.5], pressures: [6e6, 1e7], "
          "end_stops: {stiffness: 1e8, damping: 1e3}, cushions: {lengths: [0.1, 0.1], areas: [2e-6, 2e-6], port_area: "
          "1e-4}",
      "", 0);
  int looked = 0;
  double free_speed = 0, back = 0;
  run_hydraulics(text, {.h = 2e-4, .end = 1.02, .rho = 0.5}, [&](const Session& session) {
    const double t = session.time(), l = number(session, "elements/jack/length"),
                 v = number(session, "elements/jack/rate");
    if (l < 1.39) free_speed = std::max(free_speed, v);
    if (t > 1) back = std::max(back, -v);
    if (t > 1 || l < 1.44 || l > 1.499) return;
    const double p1 = number(session, "elements/jack/pressure", 0), p2 = number(session, "elements/jack/pressure", 1),
                 outside = number(session, "hydraulics/jack.port_2/pressure");
    const double u = (1.5 - l) / length, open = u * u * u * (10 - u * (15 - 6 * u));
    const double area = narrow + (port_area - narrow) * open;
    CAPTURE(t, l);
    CHECK(A2 * v == Approx(0.7 * area * std::sqrt(2 * (p2 - outside) / 850)).epsilon(0.02));
    CHECK(p2 * A2 == Approx(p1 * A1).epsilon(0.02));
    ++looked;
  });
  CHECK(looked > 20);
  CHECK(free_speed > 3);
  CHECK(back > 0.5 * free_speed);
}

TEST_CASE("a cylinder that is pressed against its stop gives by force over stiffness") {
  const std::string text = lifted(
      500, 1.2,
      "ambient_pressure: 0, piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-4, 1e-4], stroke: [1, 1.3], pressures: "
      "[2e6, 1e6], friction: {viscous: 1e4}, supply: {pressure: 1e7, tank: 0}, valve: {area: 2e-5, command: 1}, "
      "end_stops: {stiffness: 1e7, damping: 1e5}");
  const std::vector<double> found = at_end(text, {.h = 2e-3, .end = 2, .rho = 0.6},
                                           {"elements/jack/length", "elements/jack/stop_force", "elements/jack/rate"});
  const double F = 1e7 * 2e-3 - 500 * g;  // p_2 falls to the pressure of the tank
  CHECK(found[0] == Approx(1.3 + F / 1e7).epsilon(1e-6));
  CHECK(found[1] == Approx(-F).epsilon(1e-4));
  CHECK(std::abs(found[2]) < 1e-6);
}

TEST_CASE("a chamber without stops tells when it is driven out of its stroke") {
  for (const double end : {0.1, 0.6}) {
    const std::string text = lifted(
        500, 1.2,
        "piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-4, 1e-3], stroke: [1, 1.3], supply: {pressure: 1e7, tank: "
        "101325}, valve: {area: 2e-5, command: 1}");
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    DynamicsOptions options;
    options.duration = end;
    options.stepping.size = 2e-3;
    session.begin_analysis("dynamic");
    session.dynamics(options).finish();
    const std::string told = session.gathered();
    CAPTURE(told);
    CHECK((told.find("hydraulic_actuator 'jack' left its stroke of 1 to 1.3 m") != std::string::npos) == (end > 0.5));
  }
}

TEST_CASE("a cylinder that is driven out of its stroke tells where it was farthest, also in a run that goes on") {
  // The ends move apart by x = 0.2 sin(2 pi t); the longest and the shortest length are 1.2 m at 0.25 s and 0.8 m at
  // 0.75 s. Strokes that are exceeded by 5 % of their length are reported, and one that ends there is not.
  const auto told = [](double shortest, double longest, double save) {
    const std::string text = fmt::format(
        "nodes:\n  end: {{position: [0, 0, 1], motion: {{z: \"0.2*sin(2*pi*t)\"}}, fixed: [x, y, rx, ry, rz]}}\n"
        "elements:\n  jack: {{type: hydraulic_actuator, nodes: [ground, end], piston_areas: [1e-3, 0], dead_volumes: "
        "[1e-2], stroke: [{}, {}], ports: [room]}}\n"
        "hydraulics:\n  supplies: {{room: {{pressure: 1e6}}}}\n",
        shortest, longest);
    const MechanismFile file = read_mechanism_text(text, "model.yaml"), same = read_mechanism_text(text, "model.yaml");
    Session session(file.model), other(same.model);
    DynamicsOptions options;
    options.duration = 1;
    options.stepping.size = 1e-2;
    session.begin_analysis("dynamic");
    Motion motion = session.dynamics(options);
    if (save == 0) {
      motion.finish();
      return session.gathered();
    }
    motion.advance_to(save);
    const std::vector<double> saved = session.save();
    other.begin_analysis("dynamic");
    other.dynamics(options, saved).finish();
    return other.gathered();
  };
  for (const double save : {0.0, 0.5, 0.9}) {
    CAPTURE(save);
    CHECK_THAT(told(0.7, 1.17619, save), Catch::Contains("it was 1.2 m long at t = 0.25 s"));
    CHECK_THAT(told(0.82381, 1.3, save), Catch::Contains("it was 0.8 m long at t = 0.75 s"));
    CHECK(told(0.8, 1.2, save).empty());
  }
}

TEST_CASE("a cylinder that starts at the end of its stroke is pressed against its stop") {
  // The length is 1.5 m exactly; the pressure, less the load, pushes outwards by F from rest.
  const std::string text = lifted(
      500, 1.5,
      "piston_areas: [2e-3, 0], dead_volumes: [1e-4], stroke: [1, 1.5], ports: [room], friction: {viscous: 1e4}, "
      "end_stops: {stiffness: 1e7, damping: 1e5}",
      "hydraulics:\n  supplies: {room: {pressure: 10101325}}\n");
  const double F = 1e7 * 2e-3 - 500 * g;
  const std::vector<double> found =
      at_end(text, {.h = 1e-3, .end = 1, .rho = 0.6}, {"elements/jack/length", "elements/jack/stop_force"});
  CHECK(found[0] == Approx(1.5 + F / 1e7).epsilon(1e-9));
  CHECK(found[1] == Approx(-F).epsilon(1e-6));
}

TEST_CASE("the energy of a cylinder that bounces on its stop is balanced") {
  // The pressure is given, so that its work over the ambient pressure is the input: 20 kJ per metre.
  const MechanismFile file = read_mechanism_text(
      lifted(500, 1.4,
             "piston_areas: [2e-3, 0], dead_volumes: [1e-4], stroke: [1, 1.5], ports: [room], end_stops: {stiffness: "
             "1e7, damping: 2e4}",
             "hydraulics:\n  supplies: {room: {pressure: 10101325}}\n"),
      "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = 0.4;
  options.stepping.size = 2e-4;
  options.scheme = Scheme::generalized_alpha(0.9);
  Motion motion = session.dynamics(options);
  double farthest = 0, returned = 1;
  while (motion.step()) {
    const double l = number(session, "elements/jack/length");
    farthest = std::max(farthest, l);
    if (farthest > 1.5) returned = std::min(returned, l - 1.5);
  }
  CHECK(farthest > 1.51);
  CHECK(returned < -1e-3);  // it left the stop
  const Energy energy = motion.energy();
  CHECK(energy.dissipation > 100);
  CHECK(number(session, "energy/balance") == Approx(0).margin(0.5));
}

TEST_CASE("a change of stages stiffens or softens a cylinder by the pressure times the slope of its area") {
  // In the middle of a transition over 2 % of 0.5 m the quintic step has the slope 15/8.
  const MechanismFile file = read_mechanism_text(
      lifted(500, 1.5,
             "stages: [{piston_areas: [4e-3], length: 0.5}, {piston_areas: [2e-3], length: 0.5}], stroke: [1, 2], "
             "ports: [room]",
             "hydraulics:\n  supplies: {room: {pressure: 10101325}}\n"),
      "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = options.stepping.size = 1e-9;
  const Motion motion = session.dynamics(options);
  DenseModel dense(file.model);
  int z = -1;
  for (int k = 0; k < dense.nodes(); ++k)
    if (file.model.node(k).name == "mass") z = 6 * k + 2;
  REQUIRE(z >= 0);
  const double over = 1e7, slope = (2e-3 - 4e-3) * 15.0 / 8 / (0.02 * 0.5);
  CHECK(dense.tangent(motion.state(), DenseModel::Part::K)(z, z) == Approx(-over * slope).epsilon(1e-9));
}

TEST_CASE("a stage between longer ones has its own area and volume") {
  // Transitions are 2 % of the shorter of two stages: 0.08 mm about the ends of a stage of 4 mm, which leave its
  // middle.
  const ChamberSpace space(1, 1e-4, 1, {{4e-3, 0.3}, {2e-3, 0.004}, {1e-3, 0.3}});
  const ChamberSpace::Value middle = space.at(1.302);
  CHECK(middle.V == Approx(1e-4 + 4e-3 * 0.3 + 2e-3 * 0.002).epsilon(1e-12));
  CHECK(middle.V_l == Approx(2e-3).epsilon(1e-12));
  CHECK(middle.V_ll == Approx(0).margin(1e-12));
  CHECK(space.at(1.604).V == Approx(1e-4 + 4e-3 * 0.3 + 2e-3 * 0.004 + 1e-3 * 0.3).epsilon(1e-12));
}

TEST_CASE("tiny chambers do not limit the step: steps of 30 hydraulic periods come to the steady speed") {
  // Period 2 pi sqrt(m V/(B A^2)) = 0.33 ms; A_1 v = C_d a sqrt(2 (p_s - p_1)/rho), A_2 v = C_d a sqrt(2 p_2/rho).
  const std::string text = lifted(
      100, 1.01,
      "ambient_pressure: 0, bulk_modulus: 1.4e9, piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-8, 1e-8], stroke: "
      "[1, 2.5], pressures: [1e6, 1e6], supply: {pressure: 1e7, tank: 0}, valve: {area: 5e-6, command: "
      "\"step(t, 0, 0.1)\", transition_pressure: 10}",
      "", 0);
  for (const double rho : {0.0, 0.8}) {
    CAPTURE(rho);
    const std::vector<double> found = at_end(text, {.h = 1e-2, .end = 2, .rho = rho},
                                             {"elements/jack/rate", "elements/jack/pressure", "elements/jack/length"});
    // p_1 A_1 = p_2 A_2 and Q_1/A_1 = Q_2/A_2
    const double r = 2e-3 / 1.2e-3, p1 = 1e7 / (1 + r * r * r), v = 0.7 * 5e-6 * std::sqrt(2 * (1e7 - p1) / 850) / 2e-3;
    CHECK(found[0] == Approx(v).epsilon(1e-5));
    CHECK(found[1] == Approx(p1).epsilon(1e-5));
    CHECK(found[3] == Approx(1.01 + v * 1.95).epsilon(1e-3));
  }
}

TEST_CASE("a cavity is filled in the time that its pump takes for its space") {
  // The piston is drawn out by 0.5 litres in 0.2 s; 0.1 litres a second fill the cavity from then on.
  for (const char* conserves : {"volume", "mass"}) {
    const std::string text = fmt::format(
        "nodes:\n  end: {{position: [0, 0, 1.5], motion: {{z: \"0.5*step(t, 0, 0.2)\"}}, fixed: [x, y, rx, ry, rz]}}\n"
        "elements:\n  jack: {{type: hydraulic_actuator, nodes: [ground, end], piston_areas: [1e-3, 0], dead_volumes: "
        "[1e-5], stroke: [1, 2.1], ports: [room]}}\n"
        "hydraulics:\n  fluid: {{conserves: {}}}\n  volumes: {{room: {{volume: 1e-5, pressure: 101325}}}}\n"
        "  supplies: {{pump: {{to: room, flow: \"if(t > 0.2, 1e-4, 0)\"}}}}\n",
        conserves);
    double filled = 0;
    run_hydraulics(text, {.h = 1e-2, .end = 6}, [&](const Session& session) {
      if (filled == 0 && session.time() > 0.3 && number(session, "elements/jack/pressure") > p_a)
        filled = session.time();
    });
    CAPTURE(conserves);
    // The remaining vapour of 1000 Pa is negligible; fluid at one atmosphere less occupies 1e-4 more of its volume.
    CHECK(filled == Approx(5.2).margin(0.03));
  }
}

TEST_CASE("an actuator without a given pressure holds its load through statics and the motion after it") {
  // There are two analyses: the mass settles on its oil, and then starts its motion without a jump of the acceleration.
  const std::string text = lifted(500, 1.2,
                                  "piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-4, 1e-4], stroke: [1, 1.5], "
                                  "friction: {viscous: 1000}");
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  CHECK(number(session, "elements/jack/length") == Approx(1.2).epsilon(1e-9));
  CHECK(number(session, "elements/jack/pressure") == Approx(p_a + 500 * g / 2e-3).epsilon(1e-9));
  DynamicsOptions options;
  options.duration = 0.1;
  options.stepping.size = 1e-3;
  session.dynamics(options).finish();
  CHECK(number(session, "elements/jack/length") == Approx(1.2).epsilon(1e-9));
  CHECK(number(session, "elements/jack/pressure") == Approx(p_a + 500 * g / 2e-3).epsilon(1e-8));
}

TEST_CASE("adaptive steps follow a valve that opens and closes, and shorten where it does") {
  const std::string text = lifted(
      500, 1.2,
      "ambient_pressure: 0, piston_areas: [2e-3, 1.2e-3], dead_volumes: [1e-3, 0.2e-3], stroke: [1, 1.5], pressures: "
      "[6e6, 1e7], leakage: 1e-12, friction: {viscous: 1500}, supply: {pressure: 21e6, tank: 5e6}, valve: {area: 5e-6, "
      "command: \"step(t, 0.05, 0.06) - step(t, 0.2, 0.26)\", transition_pressure: 1e4}",
      "", 0);
  const std::vector<std::string> asked = {"elements/jack/length", "elements/jack/pressure"};
  const std::vector<double> fine = at_end(text, {.h = 2.5e-5, .end = 0.4}, asked);
  double before = 1;
  for (const double tolerance : {1e-5, 1e-6, 1e-7}) {
    const std::vector<double> found = at_end(text, {.h = 1e-3, .end = 0.4, .tolerance = tolerance}, asked);
    const double error = std::max(
        {std::abs(found[0] - fine[0]) / 0.1, std::abs(found[1] - fine[1]) / 1e7, std::abs(found[2] - fine[2]) / 1e7});
    CAPTURE(tolerance, error);
    CHECK(error < 0.5 * before);
    before = error;
  }
  CHECK(before < 5e-3);
}

}  // namespace test_cylinder_parts
