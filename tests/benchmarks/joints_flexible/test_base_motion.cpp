// Bases that are moved by their acceleration, and oscillators on them, against closed forms.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using bielle::test::move;

namespace {

/// Returns an oscillator of 2 kg and 200 N/m on a base that moves along x.
std::string oscillator(const std::string& motion) {
  return "nodes:\n  base: {fixed: [y, z, rx, ry, rz], motion: {x: " + motion + R"yaml(}}
  mass: {position: [0, 0, 0], fixed: [y, z, rx, ry, rz]}
elements:
  mass: {type: point_mass, node: mass, mass: 2}
joints:
  it: {type: bushing, nodes: [base, mass], stiffness: [200, 1, 1, 1, 1, 1]}
)yaml";
}

struct Corner {
  double t, a;
};
const std::vector<Corner> record = {{0, 0}, {0.1, 3}, {0.15, -2}, {0.4, 1}, {0.6, 0}, {3, 0}};

/// Returns the exact displacements of the base and of the oscillator (w = 10 rad/s) relative to it: between corners a =
/// a_0 + s tau and u'' + w^2 u = -a have the solutions below.
struct Exact {
  double x = 0, v = 0, u = 0, udot = 0;
  static Exact at(double t) {
    constexpr double w = 10;
    Exact e;
    for (std::size_t k = 1; k < record.size() && record[k - 1].t < t; ++k) {
      const double h = std::min(t, record[k].t) - record[k - 1].t, a = record[k - 1].a;
      const double s = (record[k].a - a) / (record[k].t - record[k - 1].t);
      const double A = e.u + a / (w * w), B = (e.udot + s / (w * w)) / w, c = std::cos(w * h), n = std::sin(w * h);
      e.x += h * (e.v + h * (a / 2 + s * h / 6));
      e.v += h * (a + s * h / 2);
      e.u = A * c + B * n - (a + s * h) / (w * w);
      e.udot = w * (B * c - A * n) - s / (w * w);
    }
    return e;
  }
};

void integrate(const MechanismFile& file, double h, double end, const bielle::test::Look& look) {
  Session session(file.model);
  DynamicsOptions options;
  options.duration = end;
  options.stepping.size = h;
  Motion motion = session.dynamics(options);
  while (motion.step()) look(session);
}

}  // namespace

TEST_CASE("a base follows its record of accelerations exactly, and an oscillator on it Duhamel's integral") {
  const bielle::test::TemporaryFolder folder;
  std::ofstream table(folder.path() + "/quake.csv");
  for (const Corner& corner : record) table << corner.t << ", " << corner.a << "\n";
  table.close();
  const MechanismFile file =
      read_mechanism_file(folder.file("model.yaml", oscillator("{acceleration: {table: quake.csv}}")));
  double error[2] = {0, 0};
  for (const int k : {0, 1})
    integrate(file, k == 0 ? 2e-3 : 1e-3, 2, [&](const Session& session) {
      const Exact exact = Exact::at(session.time());
      const NodeState& base = session.node("base");
      CHECK(base.x[0] == Approx(exact.x).margin(1e-13));
      CHECK(base.v[0] == Approx(exact.v).margin(1e-13));
      error[k] = std::max(error[k], std::abs(session.node("mass").x[0] - base.x[0] - exact.u));
    });
  CHECK(error[1] < 1e-5);  // relative to 0.02
  CHECK(error[0] / error[1] == Approx(4).epsilon(0.1));
}

TEST_CASE("accelerations may be formulas, with a velocity and a displacement at the start") {
  const MechanismFile file = read_mechanism_text(
      oscillator("{acceleration: \"2*sin(3*t)\", velocity: 0.4, displacement: -0.1}"), "model.yaml");
  integrate(file, 0.05, 4, [&](const Session& session) {
    const double t = session.time();
    const NodeState& base = session.node("base");
    CHECK(base.x[0] == Approx(-0.1 + 0.4 * t + 2. / 3 * t - 2. / 9 * std::sin(3 * t)).margin(2e-13));
    CHECK(base.v[0] == Approx(0.4 + 2. / 3 * (1 - std::cos(3 * t))).margin(2e-13));
    CHECK(base.a[0] == Approx(2 * std::sin(3 * t)).margin(1e-14));
  });
}

TEST_CASE("accelerations by formula are integrated as well after many periods") {
  const MechanismFile file = read_mechanism_text(oscillator("{acceleration: \"sin(2*pi*t)\"}"), "model.yaml");
  integrate(file, 0.7, 200, [&](const Session& session) {
    const double t = session.time(), w = 2 * M_PI;
    CHECK(session.node("base").x[0] == Approx(t / w - std::sin(w * t) / (w * w)).margin(1e-10));
  });
}

TEST_CASE("a run beyond the end of a record says so") {
  const bielle::test::TemporaryFolder folder;
  std::ofstream(folder.path() + "/quake.csv") << "0,0\n0.1,1\n0.2,0\n";
  const MechanismFile file =
      read_mechanism_file(folder.file("model.yaml", oscillator("{acceleration: {table: quake.csv}}")));
  integrate(file, 0.01, 0.2, [](const Session&) {});
  CHECK_THROWS_AS(integrate(file, 0.01, 0.3, [](const Session&) {}), bielle::ComputationError);
}

TEST_CASE("slips in a motion by acceleration are refused with their key") {
  const auto message = [](const std::string& motion) -> std::string {
    try {
      read_mechanism_text(oscillator(motion), "model.yaml");
    } catch (const bielle::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  using Catch::Contains;
  CHECK_THAT(message("{velocity: 1}"), Contains("nodes.base.motion.x") && Contains("acceleration"));
  CHECK_THAT(message("{acceleration: \"w*t\"}"), Contains("nodes.base.motion.x.acceleration") && Contains("w"));
  CHECK_THAT(message("{acceleration: {table: none.csv}}"),
             Contains("motion.x.acceleration.table") && Contains("no such file"));
  CHECK_THAT(message("{acceleration: {file: none.csv}}"), Contains("'file'"));
  CHECK_THAT(message("{acceleration: 1, speed: 2}"), Contains("'speed'"));
  CHECK_THAT(message("{acceleration: 1, velocity: fast}"), Contains("motion.x.velocity"));
  CHECK_THAT(message("{acceleration: 1, displacement: [1]}"), Contains("motion.x.displacement"));
}
