// State spaces against frequency responses, modes and motions in time.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/analyses/state_space.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;
using Complex = std::complex<double>;

namespace {

Eigen::MatrixXcd response(const StateSpace& found, double frequency) {
  const Eigen::MatrixXcd pencil = Complex(0, two_pi * frequency) * found.E.cast<Complex>() - found.A.cast<Complex>();
  return found.C.cast<Complex>() * Eigen::FullPivLU<Eigen::MatrixXcd>(pencil).solve(found.B.cast<Complex>()) +
         found.D.cast<Complex>();
}

/// Returns the largest difference from frequency_response, relative to the largest response at that frequency.
double difference(Session& session, const StateSpaceOptions& options, const std::vector<double>& frequencies) {
  const StateSpace found = compute_state_space(session, options);
  FrequencyResponseOptions same{options.inputs, options.outputs, frequencies, options.rotation};
  const FrequencyResponse exact = compute_frequency_response(session, same);
  double most = 0;
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    const Eigen::MatrixXcd H = response(found, frequencies[k]);
    for (Eigen::Index i = 0; i < H.rows(); ++i)
      most = std::max(
          most, (H - exact.response[k]).row(i).cwiseAbs().maxCoeff() / exact.response[k].row(i).cwiseAbs().maxCoeff());
  }
  return most;
}

/// Eigenvalues with Im s >= 0, by size.
std::vector<Complex> eigenvalues(const StateSpace& found) {
  const Eigen::EigenSolver<MatrixX> solver(Eigen::FullPivLU<MatrixX>(found.E).solve(found.A));
  std::vector<Complex> values;
  for (const Complex s : solver.eigenvalues())
    if (s.imag() >= 0) values.push_back(s);
  std::sort(values.begin(), values.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  return values;
}

/// A pendulum of two rods with joints, dampers, a filtered follower of its speed and a spring in series with a damper
/// whose common node has no mass.
const std::string mechanism =
    "gravity: [0, 0, -9.81]\ninputs: {push: {start: 0, units: N}}\n"
    "nodes: {a: {position: [0, 0, -1]}, b: {position: [0, 0, -2]},\n"
    "  between: {position: [1, 0, -1], fixed: [y, z, rx, ry, rz]}}\n"
    "elements:\n  a: {type: rigid_body, node: a, mass: 3, inertia: [0.5, 0.4, 0.3]}\n"
    "  b: {type: rigid_body, node: b, mass: 2, inertia: [0.2, 0.3, 0.1]}\n"
    "  spring: {type: spring_damper, nodes: [a, between], stiffness: 300}\n"
    "  damper: {type: spring_damper, nodes: [between, wall], damping: 20}\n"
    "joints:\n"
    "  top: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 1, 0], second_axis: [1, 0, 0]}\n"
    "  middle: {type: hinge, nodes: [a, b], position: [0, 0, -1.5], axis: [0, 1, 0], second_axis: [1, 0, 0]}\n"
    "loads: {p: {node: b, force: [\"push + slow\", 0, 0]}}\n"
    "measures: {swing: top.angle, speed: b.velocity.x, bears: top.reaction.x}\n"
    "states: {slow: {rate: \"-3*slow + speed + 0.2*push\", start: 0, units: N}}\n";

StateSpaceOptions options_of(const ModesOf& model) {
  StateSpaceOptions options;
  const int b = *model.file.model.find_node("b");
  options.inputs = {{"push", -1, false, Vector3::Zero()}, {"moment", b, true, Vector3::UnitY()}};
  options.outputs = {{"swing", -1, false, {}},
                     {"speed", -1, false, {}},
                     {"bears", -1, false, {}},
                     {"moves", b, false, Vector3::UnitX()}};
  return options;
}

std::string with_wall() {
  std::string text = mechanism;
  text.replace(text.find("  between:"), 0, "  wall: {position: [2, 0, -1], fixed: true},\n");
  return text;
}

}  // namespace

TEST_CASE("a state space has the frequency response of the equations with constraints", "[linearised]") {
  const ModesOf model(with_wall());
  CHECK(difference(model.session, options_of(model), {1e-3, 0.01, 0.3, 0.7, 2, 10, 100}) < 1e-9);
}

TEST_CASE("its eigenvalues are those of `eigen`: two swings, a damper in series and a filter", "[linearised]") {
  const ModesOf model(with_wall());
  const std::vector<Complex> found = eigenvalues(compute_state_space(model.session, options_of(model)));
  const ModesReport modes = model();
  REQUIRE(found.size() == modes.found.modes.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    CHECK(std::abs(found[k] - modes.found.modes[k].s) < 1e-9 * std::abs(found[k]));
}

TEST_CASE("a step of a small input moves the program as it moves the state space: to the square of its size",
          "[linearised]") {
  const ModesOf model(with_wall());
  const StateSpace found = compute_state_space(model.session, options_of(model));
  const Eigen::FullPivLU<MatrixX> E(found.E);
  const Eigen::EigenSolver<MatrixX> solver(E.solve(found.A));
  constexpr double end = 1;
  Eigen::VectorXcd grown = Eigen::FullPivLU<Eigen::MatrixXcd>(solver.eigenvectors())
                               .solve(Eigen::VectorXcd(E.solve(found.B.col(0)).cast<Complex>()));
  for (Eigen::Index k = 0; k < grown.size(); ++k)
    grown[k] *= (std::exp(solver.eigenvalues()[k] * end) - 1.0) / solver.eigenvalues()[k];
  const double expected = (found.C.row(0).cast<Complex>() * solver.eigenvectors() * grown).value().real();
  const auto error = [&](double push) {
    ModesOf moving(with_wall());
    moving.session.set_input("push", push);
    DynamicsOptions options;
    options.duration = end;
    options.stepping.size = 5e-4;
    options.scheme = Scheme::generalized_alpha(1);
    moving.session.dynamics(options).finish();
    return std::abs(moving.session.measure("swing") / push / expected - 1);
  };
  const double least = error(1e-3), small = error(2), twice = error(4);
  CAPTURE(least, small, twice);
  CHECK(least < 1e-5);  // error of the step alone
  CHECK(small > 20 * least);
  CHECK(twice / small == Approx(4).epsilon(0.1));
}

TEST_CASE("slow eigenvalues keep their digits next to fast ones", "[linearised]") {
  // The shift lies between 1 rad/s and 1e6 rad/s, at 1e3 rad/s, which costs 6 of 16 digits.
  const ModesOf model(
      "nodes: {a: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}, b: {position: [2, 0, 0], fixed: [y, z, rx, ry, "
      "rz]}}\n"
      "elements:\n  a: {type: point_mass, node: a, mass: 2}\n  b: {type: point_mass, node: b, mass: 1}\n"
      "  s: {type: spring_damper, nodes: [ground, a], stiffness: 2}\n"
      "  t: {type: spring_damper, nodes: [ground, b], stiffness: 1.0e+12}\n");
  const int a = *model.file.model.find_node("a");
  const StateSpaceOptions options{{{"f", a, false, Vector3::UnitX()}}, {{"x", a, false, Vector3::UnitX()}}, {}};
  CHECK(difference(model.session, options, {0, 0.1, 0.2, 1}) < 1e-8);
  const ModesReport modes = model();
  REQUIRE(modes.found.modes.size() == 2);
  CHECK(std::abs(modes.found.modes[0].s) == Approx(1).epsilon(1e-9));
  CHECK(std::abs(modes.found.modes[1].s) == Approx(1e6).epsilon(1e-9));
}

TEST_CASE("a state space of an oscillator is that of the textbook", "[linearised]") {
  const ModesOf model(
      "nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
      "elements:\n  m: {type: point_mass, node: m, mass: 2}\n"
      "  s: {type: spring_damper, nodes: [ground, m], stiffness: 200, damping: 3}\n");
  const int m = *model.file.model.find_node("m");
  const StateSpace found = compute_state_space(
      model.session, {{{"f", m, false, Vector3::UnitX()}}, {{"x", m, false, Vector3::UnitX()}}, {}});
  REQUIRE(found.E.rows() == 2);
  CHECK(found.D(0, 0) == 0);
  const MatrixX inverse = found.E.inverse(), A = inverse * found.A, B = inverse * found.B;
  // Markov parameters: C B = 0, C A B = 1/m, C A^2 B = -c/m^2; trace -c/m, determinant k/m.
  CHECK(std::abs((found.C * B)(0, 0)) < 1e-14);
  CHECK((found.C * A * B)(0, 0) == Approx(0.5).epsilon(1e-12));
  CHECK((found.C * A * A * B)(0, 0) == Approx(-0.75).epsilon(1e-12));
  CHECK(A.trace() == Approx(-1.5).epsilon(1e-12));
  CHECK(A.determinant() == Approx(100).epsilon(1e-12));
}
