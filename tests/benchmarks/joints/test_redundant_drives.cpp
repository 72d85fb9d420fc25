// Redundant drives, locks and contacts: their forces are those of smallest norm, wherever they are reported or
// compared, in any order of the file.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/analysis.hpp"
#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"

using namespace bielle::mechanism;
using bielle::test::move;
using bielle::test::move_to;
using Catch::Contains;

namespace {

/// Returns 10 kg on equal vertical guides, whose entries may have more keys. @param drives  drives of the file
std::string lift(const std::vector<std::string>& guides, const std::string& drives) {
  std::string text =
      "gravity: [0, 0, -10]\n"
      "nodes: {b: {}}\n"
      "elements: {b: {type: rigid_body, node: b, mass: 10, inertia: [1, 1, 1]}}\n"
      "joints:\n";
  for (std::size_t k = 0; k < guides.size(); ++k)
    text +=
        fmt::format("  g{}: {{type: prismatic, nodes: [ground, b], position: [{:.17g}, 0, 0], axis: [0, 0, 1]{}}}\n",
                    k + 1, static_cast<double>(k) - 0.5 * static_cast<double>(guides.size() - 1), guides[k]);
  return text + drives;
}

double force(const Session& session, int guide, const char* what) {
  return session.read(fmt::format("joints/g{}/{}", guide, what))[0];
}

}  // namespace

TEST_CASE("drives that lift the same part bear equal shares, in statics and in motion") {
  for (const int count : {2, 3}) {
    std::string drives = "drives:\n";
    for (int k = count; k > 0; --k) drives += fmt::format("  d{0}: {{joint: g{0}, displacement: \"0.1*t^2\"}}\n", k);
    const std::string text = lift(std::vector<std::string>(static_cast<std::size_t>(count)), drives);
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    Session session(file.model);
    compute_statics(session);
    for (int k = 1; k <= count; ++k) CHECK(force(session, k, "drive_force") == Approx(100.0 / count).epsilon(1e-9));
    // m (g + 0.2) in motion; their work lifts 10 kg by 0.1 m and gives it the velocity 0.2 m/s.
    move_to(text, 0.01, 1, [&](const Session& moved) {
      for (int k = 1; k <= count; ++k) CHECK(force(moved, k, "drive_force") == Approx(102.0 / count).epsilon(1e-9));
      CHECK(moved.report().energy.input == Approx(10 + 0.2).epsilon(1e-8));
    });
  }
}

TEST_CASE("a drive and a lock that hold the same part share its weight") {
  for (const bool rate : {false, true}) {
    const std::string text = lift(
        {", locked: {}", ""}, fmt::format("drives: {{d: {{joint: g2, {}: 0}}}}\n", rate ? "speed" : "displacement"));
    move_to(text, 0.01, 0.05, [&](const Session& session) {
      CHECK(force(session, 1, "lock_force") == Approx(50).epsilon(1e-8));
      CHECK(force(session, 2, "drive_force") == Approx(50).epsilon(1e-8));
    });
  }
}

TEST_CASE("locks that share a load let go by their shares") {
  // The load grows by 100 N/s: each of two locks, which open at 40 N, carries half of it for 0.8 s; then the part
  // falls.
  const std::string text = lift({", locked: {release: 40}", ", locked: {release: 40}"},
                                "loads: {f: {node: b, force: [0, 0, \"100 - 100*t\"]}}\n");
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  DynamicsOptions options;
  options.duration = 1;
  options.stepping.size = 0.03;
  session.dynamics(options).finish();
  REQUIRE(events.size() == 2);
  for (const Event& event : events) {
    CHECK(event.time == Approx(0.8).epsilon(1e-8));
    CHECK_THAT(event.name, Contains("displacement is released"));
  }
  // 10 kg from 0.8 s on: a = -10 t m/s^2.
  CHECK(session.node("b").v.z() == Approx(-5 * (1 - 0.64)).epsilon(1e-3));
}

TEST_CASE("a drive that lets go at a reaction reads the smallest one") {
  // Two guides resist a side force of 100 t: each carries half of it, 30 N after 0.6 s.
  const std::string text = lift({"", ""},
                                "drives: {d: {joint: g1, displacement: 0, release: {when: \"sqrt(g2.reaction.x^2 + "
                                "g2.reaction.y^2)\", crosses: 30}}}\n"
                                "loads: {f: {node: b, force: [\"-100*t\", 0, 0]}}\n");
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<double> times;
  session.on_event([&](const Event& event) { times.push_back(event.time); });
  DynamicsOptions options;
  options.duration = 1;
  options.stepping.size = 0.03;
  session.dynamics(options).finish();
  REQUIRE(times.size() == 1);
  CHECK(times[0] == Approx(0.6).epsilon(1e-8));
}

TEST_CASE("wheels that share a load lift off together") {
  // 10 kg are pulled up by 200 t N: the force is the weight at 0.5 s, on two wheels at one place.
  const std::string text = R"yaml(
gravity: [0, 0, -10]
nodes: {b: {position: [0, 0, 0.3], fixed: [x, y, rx, ry, rz]}}
elements: {b: {type: rigid_body, node: b, mass: 10, inertia: [1, 1, 1]}}
joints:
  front: {type: wheel, nodes: [ground, b], at: [[1, 0, 0], [1, 0, 0]], normal: [0, 0, 1], axis: [0, 1, 0], radius: 0.3}
  rear: {type: wheel, nodes: [ground, b], at: [[-1, 0, 0], [-1, 0, 0]], normal: [0, 0, 1], axis: [0, 1, 0], radius: 0.3}
loads: {f: {node: b, force: [0, 0, "200*t"]}}
)yaml";
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  std::vector<Event> events;
  session.on_event([&](const Event& event) { events.push_back(event); });
  DynamicsOptions options;
  options.duration = 1;
  options.stepping.size = 0.03;
  session.dynamics(options).finish();
  REQUIRE(events.size() == 2);
  for (const Event& event : events) CHECK(event.time == Approx(0.5).epsilon(1e-8));
  CHECK_THAT(events[0].name + events[1].name, Contains("'front': lifts off") && Contains("'rear': lifts off"));
}

TEST_CASE("summaries name the drives and locks whose forces are not unique") {
  const MechanismFile file =
      read_mechanism_text(lift({", locked: {}", "", ""},
                               "drives: {d2: {joint: g2, displacement: 0}, d3: {joint: g3, displacement: 0}}\n"
                               "analysis: [{type: static}]\n"),
                          "model.yaml");
  Session session(file.model);
  CHECK_THAT(file.analyses[0]->run(session).text,
             Contains("the reactions of joints 'g1', 'g2', 'g3', the forces of drives 'd2', 'd3' and the force of the "
                      "lock of joint 'g1' are not unique: the smallest are reported"));
}

TEST_CASE("the drives of a six-legged platform bear what its joints bear") {
  // Universal joints at both ends of each leg, 1 g in either half at a quarter of its length from the end: with the
  // angle theta of the legs to the vertical, T cos(theta) = M g/6 + m g sin(theta)^2 pushes the platform, and the drive
  // bears the upper half as well, T + m g cos(theta).
  std::string nodes = "nodes:\n  p: {position: [0, 0, 0.7]}\n",
              bodies = "elements:\n  p: {type: rigid_body, node: p, mass: 40, inertia: [2, 2, 3]}\n",
              joints = "joints:\n", drives = "drives:\n";
  const auto text = [](const Vector3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z()); };
  double cosine = 0;
  for (int k = 0; k < 6; ++k) {
    const double one = (120 * ((k + 1) / 2) + (k % 2 == 0 ? 10 : -10)) * M_PI / 180,
                 other = (120 * ((k + 1) / 2) + (k % 2 == 0 ? 50 : -50)) * M_PI / 180;
    const Vector3 foot(0.6 * std::cos(one), 0.6 * std::sin(one), 0),
        head(0.35 * std::cos(other), 0.35 * std::sin(other), 0.7), u = (head - foot).normalized(),
                                                                   across = u.cross(Vector3::UnitZ()).normalized();
    cosine = u.z();
    for (const auto& [name, share] : {std::pair("a", 0.25), std::pair("b", 0.75)}) {
      nodes += fmt::format("  {}{}: {{position: {}}}\n", name, k, text(foot + share * (head - foot)));
      bodies += fmt::format("  {0}{1}: {{type: rigid_body, node: {0}{1}, mass: 0.001, inertia: [1e-5, 1e-5, 1e-5]}}\n",
                            name, k);
    }
    const std::string axes = fmt::format("axis: {}, second_axis: {}", text(across), text(u.cross(across)));
    joints +=
        fmt::format("  u{0}: {{type: universal, nodes: [ground, a{0}], position: {1}, {2}}}\n", k, text(foot), axes);
    joints += fmt::format("  t{0}: {{type: universal, nodes: [p, b{0}], position: {1}, {2}}}\n", k, text(head), axes);
    joints += fmt::format("  l{0}: {{type: prismatic, nodes: [a{0}, b{0}], axis: {1}}}\n", k, text(u));
    drives += fmt::format("  d{0}: {{joint: l{0}, displacement: 0}}\n", k);
  }
  const MechanismFile file =
      read_mechanism_text("gravity: [0, 0, -9.81]\n" + nodes + bodies + joints + drives, "m.yaml");
  Session session(file.model);
  compute_statics(session);
  const double weight = 0.001 * 9.81, T = (40 * 9.81 / 6 + weight * (1 - cosine * cosine)) / cosine;
  for (int k = 0; k < 6; ++k)
    CHECK(session.read(fmt::format("joints/l{}/drive_force", k))[0] == Approx(T + weight * cosine).epsilon(1e-8));
}

TEST_CASE("hydraulic cylinders that hold the same part share its weight, whatever their pistons") {
  // The pressures of the start follow from the load: 50 N each, less the compression of the fluid in 1 ms.
  const auto cylinder = [](int number, double x, double area) {
    return fmt::format(
        "  c{0}: {{type: hydraulic_actuator, nodes: [ground, b], at: [[{1}, 0, -1], [{1}, 0, 0]], stroke: [0.5, 1.5], "
        "piston_areas: [{2}, 5e-4], dead_volumes: [1e-4, 1e-4]}}\n",
        number, x, area);
  };
  for (const double other : {1e-3, 3e-3}) {
    CAPTURE(other);
    const std::string text =
        "gravity: [0, 0, -10]\nnodes: {b: {}}\n"
        "elements:\n  b: {type: rigid_body, node: b, mass: 10, inertia: [1, 1, 1]}\n" +
        cylinder(1, -0.5, 1e-3) + cylinder(2, 0.5, other) +
        "joints: {g: {type: prismatic, nodes: [ground, b], axis: [0, 0, 1]}}\n";
    const MechanismFile file = read_mechanism_text(text, "model.yaml");
    for (const bool statics : {true, false}) {
      CAPTURE(statics);
      Session session(file.model);
      if (statics) {
        compute_statics(session);
      } else {
        DynamicsOptions options;
        options.duration = options.stepping.size = 1e-3;
        Motion motion = session.dynamics(options);
        CHECK(session.read("elements/c1/force")[0] == Approx(50).epsilon(1e-6));
        motion.finish();
      }
      for (const char* name : {"c1", "c2"})
        CHECK(session.read(fmt::format("elements/{}/force", name))[0] == Approx(50).epsilon(1e-6));
      CHECK(session.node("b").x.z() == Approx(0).margin(1e-9));
    }
  }
}
