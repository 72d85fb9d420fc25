// Springs, dampers, preloads, stops and torques on each coordinate of each lower pair: signs and sizes by closed forms.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/session_model.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;
using bielle::test::model_of;
using bielle::test::steps_of;

namespace {

struct Sample {
  const char *type, *coordinate;
  std::size_t index, count;
  bool turns;
  std::vector<const char*> others;
};
const std::vector<Sample> samples = {
    {"hinge", "angle", 0, 1, true, {}},
    {"prismatic", "displacement", 0, 1, false, {}},
    {"cylindrical", "displacement", 0, 2, false, {"angle"}},
    {"cylindrical", "angle", 1, 2, true, {"displacement"}},
    {"planar", "x", 0, 3, false, {"y", "angle"}},
    {"planar", "y", 1, 3, false, {"x", "angle"}},
    {"planar", "angle", 2, 3, true, {"x", "y"}},
    {"spherical", "rx", 0, 3, true, {"ry", "rz"}},
    {"spherical", "ry", 1, 3, true, {"rx", "rz"}},
    {"spherical", "rz", 2, 3, true, {"rx", "ry"}},
};

/// Returns a body of 2 kg and 0.5 kg m^2 in the joint, on which stiffness, damping and the other actions act. A spring
/// of 900 holds the remaining freedoms, and a drive pushes.
std::string model(const Sample& sample, const std::string& stiffness, const std::string& more,
                  const std::string& push) {
  std::string springs = fmt::format("{}: {}", sample.coordinate, stiffness);
  for (const char* other : sample.others) springs += fmt::format(", {}: 900", other);
  std::string text =
      "nodes: {body: {position: [0, 0, 0]}}\n"
      "elements: {body: {type: rigid_body, node: body, mass: 2, inertia: [0.5, 0.5, 0.5]}}\n";
  text += fmt::format(
      "joints: {{pair: {{type: {}, nodes: [ground, body], position: [0, 0, 0], axis: [0, 0, 1], "
      "stiffness: {{{}}}{}}}}}\n",
      sample.type, springs, more);
  if (!push.empty())
    text += fmt::format("drives: {{push: {{joint: pair, coordinate: {}, {}: \"{}\"}}}}\n", sample.coordinate,
                        sample.turns ? "torque" : "force", push);
  return text;
}

std::string key(const Sample& sample, const std::string& name, const std::string& value) {
  return fmt::format(", {}: {{{}: {}}}", name, sample.coordinate, value);
}

}  // namespace

TEST_CASE("a spring with its rest and preload balances a push on its coordinate") {
  for (const Sample& sample : samples) {
    INFO(sample.type << ", " << sample.coordinate);
    // 200 (q - 0.1) + 5 = 25
    Session session(model_of(model(sample, "200", key(sample, "rest", "0.1") + key(sample, "preload", "5"), "25")));
    compute_statics(session);
    for (std::size_t k = 0; k < sample.count; ++k) {
      const bool own = k == sample.index;
      CHECK(session.read("joints/pair/coordinate")[k] == Approx(own ? 0.2 : 0).margin(1e-10));
      CHECK(session.read("joints/pair/spring_force")[k] == Approx(own ? -25 : 0).margin(1e-7));
      CHECK(session.read("joints/pair/drive_force")[k] == Approx(own ? 25 : 0).margin(1e-12));
    }
    CHECK(session.energy().elastic == Approx(5 * 0.1 + 100 * 0.1 * 0.1).epsilon(1e-8));
  }
}

TEST_CASE("a stop balances what pushes beyond its range, on either side") {
  for (const Sample& sample : samples) {
    if (std::string(sample.type) == "spherical") continue;  // has no stops
    for (const double sign : {1.0, -1.0}) {
      INFO(sample.type << ", " << sample.coordinate << ", " << sign);
      // 100 q + 5000 (q - 0.1) = 20: q = 520/5100
      const std::string stops = key(sample, "stops", "{range: [-0.1, 0.1], stiffness: 5000, damping: 3}");
      Session session(model_of(model(sample, "100", stops, fmt::format("{}", 20 * sign))));
      compute_statics(session);
      const double q = sign * 520 / 5100;
      CHECK(session.read("joints/pair/coordinate")[sample.index] == Approx(q).epsilon(1e-9));
      CHECK(session.read("joints/pair/stop_force")[sample.index] == Approx(100 * q - 20 * sign).epsilon(1e-7));
      CHECK(session.read("joints/pair/spring_force")[sample.index] == Approx(-100 * q).epsilon(1e-7));
    }
  }
}

TEST_CASE("spring and damper let a coordinate oscillate, and the energy balance tells its parts") {
  for (const Sample& sample : samples) {
    INFO(sample.type << ", " << sample.coordinate);
    const double m = sample.turns ? 0.5 : 2, k = 200, d = 4, rest = 0.3;
    Session session(model_of(model(sample, "200", key(sample, "rest", "0.3") + key(sample, "damping", "4"), "")));
    const double energy = k * rest * rest / 2, delta = d / m / 2, w = std::sqrt(k / m - delta * delta), h = 5e-4;
    Motion motion = session.dynamics(steps_of(0.4, h));
    REQUIRE(motion.finish());
    const double e = std::exp(-delta * 0.4), c = std::cos(w * 0.4), s = std::sin(w * 0.4);
    const double x = -rest * e * (c + delta / w * s), v = rest * e * (k / m) / w * s;
    // The error is (omega h)^2/12 of a phase of 8: 1e-4 of the amplitude, and w times this in rates.
    CHECK(session.read("joints/pair/coordinate")[sample.index] == Approx(rest + x).margin(1e-4 * rest));
    CHECK(session.read("joints/pair/rate")[sample.index] == Approx(v).margin(1e-4 * rest * w));
    CHECK(session.read("joints/pair/spring_force")[sample.index] ==
          Approx(-k * x - d * v).margin(1e-4 * rest * (k + d * w)));
    CHECK(session.energy().dissipation == Approx(energy - k * x * x / 2 - m * v * v / 2).margin(2e-4 * energy));
    CHECK(std::abs(session.balance()) < 2e-4 * energy);
  }
}

TEST_CASE("springs of different stiffness about the axes of a spherical joint have a potential") {
  // Turns of more than a radian about all axes; K = sum of k_i psi_i^2/2 with the rotation vector psi.
  const std::string text = R"yaml(
nodes: {body: {position: [0, 0, 0], angular_velocity: [9, -7, 12]}}
elements: {body: {type: rigid_body, node: body, mass: 2, inertia: [0.3, 0.5, 0.4]}}
joints: {pair: {type: spherical, nodes: [ground, body], position: [0, 0, 0], stiffness: {rx: 60, ry: 20, rz: 90}}}
)yaml";
  const auto worst = [&](double h) {
    Session session(model_of(text));
    Motion motion = session.dynamics(steps_of(1, h));
    const double start = session.energy().kinetic;
    double largest = 0, turn = 0;
    while (motion.step()) {
      const std::vector<double> psi = session.read("joints/pair/coordinate");
      const double stored = (60 * psi[0] * psi[0] + 20 * psi[1] * psi[1] + 90 * psi[2] * psi[2]) / 2;
      CHECK(session.energy().elastic == Approx(stored).epsilon(1e-12));
      largest = std::max(largest, std::abs(session.energy().kinetic + stored - start) / start);
      turn = std::max(turn, std::hypot(psi[0], psi[1], psi[2]));
    }
    CHECK(turn > 1);
    return largest;
  };
  const double coarse = worst(2e-3), fine = worst(1e-3);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.15));
  CHECK(fine < 1e-3);
}

TEST_CASE("the law of a spring may come from a table") {
  const bielle::test::TemporaryFolder folder;
  // 100 q up to 0.1, 300 past it: 10 + 300 (q - 0.1) = 25 at 0.15; the energy is 0.5 + 10 0.05 + 150 0.05^2.
  const std::string path = folder.file("law.csv", "-1,-100\n0,0\n0.1,10\n1.1,310\n");
  for (const Sample& sample : samples) {
    INFO(sample.type << ", " << sample.coordinate);
    Session session(model_of(model(sample, fmt::format("{{table: {}}}", path), "", "25")));
    compute_statics(session);
    CHECK(session.read("joints/pair/coordinate")[sample.index] == Approx(0.15).epsilon(1e-9));
    CHECK(session.energy().elastic == Approx(0.5 + 0.5 + 0.375).epsilon(1e-9));
  }
}
