// A value of 0 of some keys removes a part: friction, stops, gaps, filters, branches, grip, masses. A model whose
// parameter is reduced to 0 equals the model without the part, or a closed form.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;

namespace {

/// Returns a measure `m` at the end of 0.2 s, or in equilibrium.
double measured(const std::string& text, bool in_motion = true) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  if (!in_motion) {
    compute_statics(session);
    return session.read("measures/m")[0];
  }
  DynamicsOptions options;
  options.duration = 0.2;
  options.stepping.size = 1e-3;
  Motion motion = session.dynamics(options);
  while (motion.step()) {
  }
  return session.read("measures/m")[0];
}

std::string pendulum(const std::string& of_joint, const std::string& more = "") {
  return "gravity: [0, 0, -9.81]\nnodes: {bob: {position: [1, 0, 0]}}\nelements: {bob: {type: rigid_body, node: bob, "
         "mass: 2, inertia: [0.1, 0.1, 0.1]}}\njoints: {pin: {type: hinge, nodes: [ground, bob], position: [0, 0, 0], "
         "axis: [0, 1, 0]" +
         of_joint + "}}\nmeasures: {m: \"pin.angle\"}\n" + more;
}

std::string journal(const std::string& of_joint) {
  return "gravity: [0, -10, 0]\nnodes: {journal: {position: [0, 0, 0], fixed: [z, rx, ry, rz]}}\nelements: {journal: "
         "{type: point_mass, node: journal, mass: 3}}\njoints: {it: {type: clearance_hinge, nodes: [ground, journal], "
         "position: [0, 0, 0], axis: [0, 0, 1], second_axis: [1, 0, 0], " +
         of_joint + "}}\nmeasures: {m: {node: journal, quantity: position, direction: y}}\n";
}

}  // namespace

TEST_CASE("friction without a coefficient or without a radius does nothing, whatever its model") {
  const double free = measured(pendulum(""));
  CHECK(free > 0.1);
  for (const char* law : {"", ", model: lugre, bristle_stiffness: 1e5, bristle_damping: 300", ", model: stick_slip"}) {
    CAPTURE(law);
    CHECK(measured(pendulum(fmt::format(", friction: {{coefficient: 0, radius: 0.05{}}}", law))) ==
          Approx(free).epsilon(1e-9));
    CHECK(measured(pendulum(fmt::format(", friction: {{coefficient: 0, static: 0, radius: 0.05{}}}", law))) ==
          Approx(free).epsilon(1e-9));
    CHECK(measured(pendulum(fmt::format(", friction: {{coefficient: 0.4, radius: 0{}}}", law))) ==
          Approx(free).epsilon(1e-9));
    CHECK(measured(pendulum(fmt::format(", friction: {{coefficient: 0.4, radius: 0.5{}}}", law))) < 0.99 * free);
  }
  // Bristles that hold, and then slide without friction, would never release.
  CHECK_THAT(bielle::test::message_of<bielle::InputError>([&] {
               measured(
                   pendulum(", friction: {coefficient: 0, static: 0.1, stribeck_velocity: 0.01, radius: 0.1, model: "
                            "lugre, bristle_stiffness: 1e5}"));
             }),
             Catch::Contains("friction.coefficient") && Catch::Contains("greater than 0"));
}

TEST_CASE("stops without stiffness and damping do not stop") {
  CHECK(measured(pendulum(", stops: {range: [-1, 0.05], stiffness: 0}")) ==
        Approx(measured(pendulum(""))).epsilon(1e-5));
}

TEST_CASE("a clearance without a gap is a spring from its middle on, without a length one place of it") {
  constexpr double k = 1e4, w2 = k / 3;
  for (const char* more : {"", ", length: 0", ", radius: 0, friction: {coefficient: 0.2}"}) {
    CAPTURE(more);
    const std::string text = journal(fmt::format("radial_gap: 0, contact: {{stiffness: {}, exponent: 1}}{}", k, more));
    CHECK(measured(text, false) == Approx(-30 / k).epsilon(1e-8));
    CHECK(measured(text) == Approx(-10 / w2 * (1 - std::cos(std::sqrt(w2) * 0.2))).epsilon(0.02));
  }
  CHECK(measured(journal("radial_gap: 0, contact: {stiffness: 1e6, exponent: 1.5}"), false) ==
        Approx(-std::pow(30 / 1e6, 2. / 3)).epsilon(1e-6));
}

TEST_CASE("filters without a time constant pass what they are given") {
  const auto driven = [](const std::string& filter) {
    return measured(pendulum(
        "", "drives: {hold: {joint: pin, pid: {target: \"0.1*sin(10*t)\", kp: 400, kd: 40" + filter + "}}}\n"));
  };
  CHECK(driven(", filter: 0") == Approx(driven("")).epsilon(1e-14));
  const std::string seen = pendulum("", "states: {seen: {filter: \"sin(3*t) + pin.angle\", time_constant: 0}}\n");
  const auto replaced = [&](const std::string& formula) {
    std::string text = seen;
    return text.replace(text.find("\"pin.angle\""), 11, "\"" + formula + "\"");
  };
  CHECK(measured(replaced("seen")) == Approx(measured(replaced("sin(3*t) + pin.angle"))).epsilon(1e-14));
  CHECK(measured(replaced("seen"), false) == Approx(measured(replaced("pin.angle"), false)).epsilon(1e-9));
}

TEST_CASE("branches of no stiffness, and those that relax in no time, bear nothing") {
  const auto swing = [](const std::string& branches) {
    return measured(
        "nodes: {a: {position: [0, 0, 0], velocity: [0.1, 0, 0], fixed: [y, z, rx, ry, rz]}}\nelements: {a: "
        "{type: point_mass, node: a, mass: 2}}\njoints: {b: {type: bushing, nodes: [ground, a], position: [0, "
        "0, 0], stiffness: [800, 1, 1, 1, 1, 1]" +
        branches + "}}\nmeasures: {m: {node: a, quantity: position, direction: x}}\n");
  };
  const double plain = swing("");
  CHECK(plain == Approx(0.1 / 20 * std::sin(20 * 0.2)).epsilon(1e-2));
  CHECK(swing(", maxwell: [{factor: 0, time: 0.01}]") == Approx(plain).epsilon(1e-9));
  CHECK(swing(", maxwell: [{factor: 1, time: 0}]") == Approx(plain).epsilon(1e-12));
  CHECK(std::abs(swing(", maxwell: [{factor: 1, time: 0.01}]") / plain - 1) > 0.01);
}

TEST_CASE("a tube without a hole is a bar, and a mass of 0 weighs nothing") {
  const auto tip = [](const std::string& section) {
    return measured(
        "nodes: {a: {position: [0, 0, 0], fixed: true}, b: {position: [1, 0, 0]}}\nelements: {rod: {type: "
        "beam, nodes: [a, b], elements: 4, section: {" +
            section +
            ", young: 2e11, poisson: 0.3, density: 7850}}}\nloads: {f: {node: b, force: [0, 0, -10]}}\n"
            "measures: {m: {node: b, quantity: position, direction: z}}\n",
        false);
  };
  CHECK(tip("tube: [0.01, 0]") == Approx(tip("circle: 0.01")).epsilon(1e-12));
  const std::string payload = pendulum("");
  std::string loaded = payload;
  loaded.replace(loaded.find("elements: {"), 11, "elements: {load: {type: point_mass, node: bob, mass: 0}, ");
  CHECK(measured(loaded) == Approx(measured(payload)).epsilon(1e-14));
}

TEST_CASE("a tyre without grip, or without stiffness, lets its wheel slide") {
  const auto speed = [](const std::string& slip) {
    return measured(
        "gravity: [0, 0, -9.81]\nnodes: {w: {position: [0, 0, 0.3], velocity: [1, 0, 0]}}\nelements: {w: "
        "{type: rigid_body, node: w, mass: 5, inertia: [0.2, 0.3, 0.2]}}\njoints: {roll: {type: wheel, nodes: "
        "[ground, w], normal: [0, 0, 1], axis: [0, 1, 0], radius: 0.3, slip: {" +
        slip + "}}}\nmeasures: {m: {node: w, quantity: velocity, direction: x}}\n");
  };
  CHECK(speed("longitudinal: 1e4, lateral: 1e4, friction: 0") == Approx(1).epsilon(1e-9));
  CHECK(speed("longitudinal: 0, lateral: 0") == Approx(1).epsilon(1e-9));
  CHECK(speed("longitudinal: 1e4, lateral: 1e4, friction: 0.5") < 0.9);
}
