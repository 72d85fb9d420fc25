// Frequency responses and state spaces of rotors behind a joint, against closed forms, periodic equations, and
// equations that are linearised about a periodic motion (tests/references/turning_orbits.py, whose responses are known
// to 1e-8).
#include <cmath>

#include "mechanism/analyses/frequency_response.hpp"
#include "mechanism/analyses/state_space.hpp"
#include "tests/benchmarks/linearised/gravity_models.hpp"
#include "tests/benchmarks/linearised/turning_models.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_turning_responses {
namespace {

using Complex = std::complex<double>;

struct Turning {
  ModesOf model;
  FrequencyResponseOptions options;
  Turning(const std::string& text, double rate) : model(text) {
    options.rotation = SteadyRotation{};
    options.rotation->joint = model.file.model.members_of({Section::joints, "shaft"}).front();
    options.rotation->rate = rate;
  }
  int node(const char* name) const { return *model.file.model.find_node(name); }
  void force(const char* at, const Vector3& direction) { options.inputs.push_back({at, node(at), false, direction}); }
  void moment(const char* at, const Vector3& direction) { options.inputs.push_back({at, node(at), true, direction}); }
  void moves(const char* at, const Vector3& direction) { options.outputs.push_back({at, node(at), false, direction}); }
  void turns(const char* at, const Vector3& direction) { options.outputs.push_back({at, node(at), true, direction}); }
  FrequencyResponse responses() const { return compute_frequency_response(model.session, options); }

  /// Returns the largest difference of the responses of the state space, relative to the largest response at a
  /// frequency.
  double difference_of_state_space() const {
    const FrequencyResponse exact = responses();
    const StateSpace found = compute_state_space(model.session, {options.inputs, options.outputs, options.rotation});
    double most = 0;
    for (std::size_t k = 0; k < options.frequencies.size(); ++k) {
      const Complex s(0, two_pi * options.frequencies[k]);
      const Eigen::MatrixXcd pencil = s * found.E.cast<Complex>() - found.A.cast<Complex>();
      const Eigen::MatrixXcd H =
          found.C.cast<Complex>() * Eigen::FullPivLU<Eigen::MatrixXcd>(pencil).solve(found.B.cast<Complex>()) +
          found.D.cast<Complex>();
      most = std::max(most, (H - exact.response[k]).cwiseAbs().maxCoeff() / exact.response[k].cwiseAbs().maxCoeff());
    }
    return most;
  }
};

/// Returns the part with the frequency of a force exp(s t) along x on a blade, of the displacement along x of a blade:
/// with x = exp(s t) p(t), p of the period of the rotation.
Complex blade_response(const LagRotor& rotor, int forced, int seen, Complex s, int steps) {
  const int n = 2 + rotor.blades;
  const auto sine_of = [&](int blade, double psi) { return std::sin(psi + two_pi * blade / rotor.blades); };
  const double arm = rotor.S / rotor.m;
  const auto rates = [&](double psi, const Eigen::MatrixXcd& p) {
    // The first columns are a fundamental system, the last is driven.
    Eigen::VectorXd Q = Eigen::VectorXd::Zero(n);
    Q[0] = 1;
    Q[2 + forced] = -arm * sine_of(forced, psi);
    Eigen::MatrixXcd change = rotor.A(psi).cast<Complex>() * p - s * p;
    change.col(2 * n).tail(n) += rotor.matrices(psi).mass.inverse() * Q;
    return change;
  };
  const double T = two_pi / rotor.rate, h = T / steps;
  Eigen::MatrixXcd p = Eigen::MatrixXcd::Zero(2 * n, 2 * n + 1);
  p.leftCols(2 * n).setIdentity();
  Eigen::RowVectorXcd mean = Eigen::RowVectorXcd::Zero(2 * n + 1);
  for (int k = 0; k < steps; ++k) {
    const double t = k * h;
    mean += (p.row(0) - arm * sine_of(seen, rotor.rate * t) * p.row(2 + seen)) / steps;
    const Eigen::MatrixXcd k1 = rates(rotor.rate * t, p), k2 = rates(rotor.rate * (t + h / 2), p + h / 2 * k1),
                           k3 = rates(rotor.rate * (t + h / 2), p + h / 2 * k2),
                           k4 = rates(rotor.rate * (t + h), p + h * k3);
    p += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  const Eigen::MatrixXcd Phi = p.leftCols(2 * n);
  const Eigen::VectorXcd start =
      Eigen::PartialPivLU<Eigen::MatrixXcd>(Eigen::MatrixXcd::Identity(2 * n, 2 * n) - Phi).solve(p.col(2 * n));
  return (mean.head(2 * n) * start)(0) + mean[2 * n];
}

}  // namespace

TEST_CASE("an unsymmetric rotor in balance moves with its hub as a mass on a spring", "[linearised]") {
  constexpr double m = 5, kx = 2e5, kz = 3e5;
  Turning rotor(disc_on_springs(m, "[0.02, 0.03, 0.04]", "[2e5, 1.2e5, 3e5, 800, 500, 500]"), 30);
  const char* const forced = GENERATE("hub", "disc");
  for (const char* seen : {"hub", "disc"}) {
    rotor.moves(seen, Vector3::UnitX());
    rotor.moves(seen, Vector3::UnitZ());
  }
  rotor.force(forced, Vector3::UnitX());
  rotor.force(forced, Vector3::UnitZ());
  rotor.options.frequencies = {1, 7, 40, 100};  // at 0 Hz the rotor turns without any force
  const FrequencyResponse found = rotor.responses();
  CHECK(found.turning->periodicity == Periodicity::periodic);
  for (std::size_t f = 0; f < rotor.options.frequencies.size(); ++f) {
    const double w = two_pi * rotor.options.frequencies[f];
    CAPTURE(forced, w);
    for (const int seen : {0, 2}) {
      CHECK(std::abs(found.response[f](seen, 0) * (kx - m * w * w) - 1.0) < 1e-9);
      CHECK(std::abs(found.response[f](seen + 1, 1) * (kz - m * w * w) - 1.0) < 1e-9);
      CHECK(std::abs(found.response[f](seen, 1)) < 1e-12);
    }
  }
  CHECK(rotor.difference_of_state_space() < 1e-8);
}

TEST_CASE("a disc on supports that differ tilts under moments as its equations say", "[linearised]") {
  // Jt a'' + Jp Om b' + k1 a = Mx, Jt b'' - Jp Om a' + k2 b = My.
  constexpr double Jp = 0.01, Jt = 0.02, k1 = 800, k2 = 500, Om = 150;
  Turning rotor(disc_on_springs(5, "[0.02, 0.02, 0.01]", "[2e5, 1.2e5, 3e5, 800, 500, 500]"), Om);
  for (const char* node : {"hub", "disc"})
    for (const Vector3& axis : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY())}) {
      rotor.moment(node, axis);
      rotor.turns(node, axis);
    }
  rotor.options.frequencies = {3, 20, 36, 60};
  const FrequencyResponse found = rotor.responses();
  CHECK(found.turning->periodicity == Periodicity::multiblade);
  for (std::size_t f = 0; f < rotor.options.frequencies.size(); ++f) {
    const double w = two_pi * rotor.options.frequencies[f];
    Eigen::Matrix2cd D;
    D << k1 - Jt * w * w, Complex(0, Jp * Om * w), Complex(0, -Jp * Om * w), k2 - Jt * w * w;
    const Eigen::Matrix2cd H = D.inverse();
    CAPTURE(w);
    for (const int seen : {0, 2})
      for (const int forced : {0, 2}) CHECK((found.response[f].block<2, 2>(seen, forced) - H).norm() < 1e-8 * H.norm());
  }
  CHECK(rotor.difference_of_state_space() < 1e-8);
}

TEST_CASE("a generator's torque turns a rotor against its support", "[linearised]") {
  // J (phi + theta)'' = T, k phi = -T: the angle of the shaft is theta.
  constexpr double J = 0.01, k = 500;
  Turning rotor(disc_on_springs(5, "[0.02, 0.03, 0.01]", "[2e5, 1.2e5, 3e5, 800, 500, 500]") +
                    "inputs: {torque: {start: 0, units: N m}}\n"
                    "drives: {generator: {joint: shaft, torque: torque}}\n"
                    "measures: {speed: shaft.angle.rate, effort: torque + 0*shaft.angle}\n",
                30);
  rotor.options.inputs = {{"torque", -1, false, Vector3::Zero()}};
  rotor.options.outputs = {{"speed", -1, false, {}}, {"effort", -1, false, {}}};
  rotor.options.frequencies = {0.5, 11, 80};
  const FrequencyResponse found = rotor.responses();
  CHECK(found.turning->periodicity == Periodicity::periodic);
  for (std::size_t f = 0; f < rotor.options.frequencies.size(); ++f) {
    const Complex s(0, two_pi * rotor.options.frequencies[f]);
    const Complex H = 1.0 / (J * s) + s / k;
    CAPTURE(s);
    CHECK(std::abs(found.response[f](0, 0) - H) < 1e-8 * std::abs(H));
    CHECK(std::abs(found.response[f](1, 0) - 1.0) < 1e-9);
  }
}

TEST_CASE("forces on blades move blades as periodic equations say, also with a damper out", "[linearised]") {
  LagRotor lag;
  const bool whole = GENERATE(true, false);
  if (!whole) lag.c[0] = 0;
  lag.ky = 0.7 * lag.kx;
  Turning rotor(lag.model(), lag.rate);
  rotor.force("blade_0", Vector3::UnitX());
  rotor.force("blade_1", Vector3::UnitX());
  rotor.moves("blade_0", Vector3::UnitX());
  rotor.moves("blade_2", Vector3::UnitX());
  rotor.options.frequencies = {0.3, 0.7, 2.3, 6};  // at 0 Hz the rotor turns without any force
  const FrequencyResponse found = rotor.responses();
  CHECK(found.turning->periodicity == (whole ? Periodicity::multiblade : Periodicity::periodic));
  for (std::size_t f = 0; f < rotor.options.frequencies.size(); ++f) {
    const Complex s(0, two_pi * rotor.options.frequencies[f]);
    for (const int forced : {0, 1})
      for (const int seen : {0, 2}) {
        const Complex H = blade_response(lag, forced, seen, s, 600);
        CAPTURE(whole, s, forced, seen, H, found.response[f](seen / 2, forced));
        CHECK(std::abs(found.response[f](seen / 2, forced) - H) < 1e-6 * std::abs(H));
      }
  }
  CHECK(rotor.difference_of_state_space() < 1e-7);
}

TEST_CASE("blades under gravity respond as their nonlinear equations, linearised about their periodic motion",
          "[linearised][long]") {
  const ReferenceTable table("turning_orbits");
  struct Case {
    const char* name;
    int count;
    double first;
  };
  for (const Case& each : {Case{"two_blades", 2, 1}, Case{"unequal_blades", 3, 1.3}}) {
    Turning rotor(blades(each.count, 60, springs, "rate: 6", 0.3, each.first), 6);
    const std::string last = fmt::format("b{}", each.count - 1);
    rotor.force("hub", Vector3::UnitY());
    rotor.force("b0", Vector3::UnitZ());
    rotor.moves("hub", Vector3::UnitY());
    rotor.moves("hub", Vector3::UnitZ());
    rotor.moves(last.c_str(), Vector3::UnitY());
    rotor.options.frequencies = {0.4, 2.1};
    const FrequencyResponse found = rotor.responses();
    CHECK(found.turning->periodicity == Periodicity::periodic);
    CHECK(found.turning->orbit_harmonics > 0);
    const std::string outputs[] = {"hub", "up", last};
    for (std::size_t f = 0; f < rotor.options.frequencies.size(); ++f)
      for (const int forced : {0, 1}) {
        Eigen::Vector3cd exact;
        for (int seen = 0; seen < 3; ++seen) {
          const std::string row = fmt::format("{}.{}.{}.{}", each.name, rotor.options.frequencies[f],
                                              forced == 0 ? "hub" : "b0", outputs[seen]);
          exact[seen] = {table(row + ".real"), table(row + ".imaginary")};
        }
        CAPTURE(each.name, rotor.options.frequencies[f], forced, exact, found.response[f].col(forced));
        CHECK((found.response[f].col(forced) - exact).norm() < 2e-8 * exact.norm());
      }
    CHECK(rotor.difference_of_state_space() < 1e-7);
  }
}

TEST_CASE("an unbalanced rotor that turns freely responds about its periodic motion", "[linearised]") {
  const ReferenceTable table("turning_orbits");
  Turning rotor(unbalanced(), 7);
  rotor.force("hub", Vector3::UnitX());
  rotor.moment("rotor", Vector3::UnitZ());
  rotor.moves("hub", Vector3::UnitX());
  rotor.turns("rotor", Vector3::UnitZ());
  rotor.options.frequencies = {0.5, 2.5};
  const FrequencyResponse found = rotor.responses();
  CHECK(found.turning->orbit_harmonics > 0);
  const char* const names[] = {"hub", "rotor"};
  for (std::size_t f = 0; f < rotor.options.frequencies.size(); ++f)
    for (const int forced : {0, 1}) {
      Eigen::Vector2cd exact;
      for (const int seen : {0, 1}) {
        const std::string row =
            fmt::format("unbalance.{}.{}.{}", rotor.options.frequencies[f], names[forced], names[seen]);
        exact[seen] = {table(row + ".real"), table(row + ".imaginary")};
      }
      CAPTURE(rotor.options.frequencies[f], forced, exact, found.response[f].col(forced));
      CHECK((found.response[f].col(forced) - exact).norm() < 2e-8 * exact.norm());
    }
  CHECK(rotor.difference_of_state_space() < 1e-7);
}

TEST_CASE("modes are not superposed where harmonics of a rotation are needed", "[linearised]") {
  Turning rotor(disc_on_springs(5, "[0.02, 0.03, 0.04]", "[2e5, 1.2e5, 3e5, 800, 500, 500]"), 30);
  rotor.force("hub", Vector3::UnitX());
  rotor.moves("hub", Vector3::UnitX());
  rotor.options.frequencies = {1};
  rotor.options.modes = 3;
  CHECK_THROWS_WITH(rotor.responses(), Catch::StartsWith("`modes`"));
}

}  // namespace test_turning_responses
