// The law of events: a crossing that changes nothing leaves motions and reactions as they are without it, to the order
// of the scheme, wherever it lies relative to the grid of steps: on a time of it, from 1e-16 s to the whole of a step
// before and behind.
//
// Such a crossing is noted within a step, or (`action: restart`) ends the step, so that what is left of it has every
// size. What may change then is measured by what steps of twice the size change. Where there is a closed form, the
// reactions are also those.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/memory_sink.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;

namespace {

struct Sample {
  const char* name;
  std::string text;
  double duration, h;
  const char* reaction;  ///< the dataset that is compared
  double size;           ///< of the reactions [N] or [N m]
};

/// A body on an arm of 0.5 m about a hinge: m r omega^2 = 123.37 N.
const std::string arm = R"yaml(
nodes: {b: {position: [0.5, 0, 0], velocity: [0, 7.853981633974483, 0], angular_velocity: [0, 0, 15.70796326794897]}}
elements: {m: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints: {s: {type: hinge, nodes: [ground, b], position: [0, 0, 0], axis: [0, 0, 1]}}
)yaml";

/// A circle of 40 mm whose middle is 10 mm away from the shaft.
void write_eccentric(const std::string& path) {
  std::ofstream out(path);
  constexpr int n = 720;
  for (int k = 0; k < n; ++k) {
    const double phi = 2 * M_PI * k / n;
    out << fmt::format("{:.17g}, {:.17g}\n", phi,
                       0.01 * std::cos(phi) + std::sqrt(0.0016 - std::pow(0.01 * std::sin(phi), 2)));
  }
}

std::vector<Sample> samples(const std::string& profile) {
  return {
      {"a driven hinge", arm + "drives: {d: {joint: s, angle: \"15.70796326794897*t\"}}\n", 0.02, 1e-3,
       "joints/s/reaction_inertial", 123.37},
      {"a pendulum", "gravity: [0, -9.81, 0]\n" + arm, 0.02, 1e-3, "joints/s/reaction_inertial", 123.37},
      {"a ball that lies and rolls on a floor", R"yaml(
gravity: [0, 0, -9.81]
nodes: {b: {position: [0, 0, 0.0999], velocity: [1, 0, 0]}}
elements: {b: {type: rigid_body, node: b, mass: 2, inertia: [0.01, 0.01, 0.01]}}
joints:
  c:
    type: contact
    shapes: [{node: ground, plane: [0, 0, 1]}, {node: b, sphere: 0.1}]
    stiffness: 1e6
    restitution: 0.5
)yaml",
       0.02, 1e-3, "joints/c/force", 20},
      {"a body pressed against a stop", R"yaml(
gravity: [0, 0, -9.81]
nodes: {b: {position: [0, 0, 0]}}
elements: {b: {type: rigid_body, node: b, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {path: {type: prismatic, nodes: [ground, b], axis: [0, 0, -1], stops: {range: [~, 0.0005], stiffness: 1800, damping: 12}}}
)yaml",
       0.04, 1e-3, "joints/path/stop_force", 20},
      {"a flat follower on an eccentric", R"yaml(
nodes: {c: {position: [0, 0, 0], angular_velocity: [0, 0, 40]}, f: {position: [0.05, 0, 0]}}
elements:
  c: {type: rigid_body, node: c, mass: 1, inertia: [0.01, 0.01, 0.01]}
  f: {type: rigid_body, node: f, mass: 0.5, inertia: [0.01, 0.01, 0.01]}
joints:
  shaft: {type: hinge, nodes: [ground, c], axis: [0, 0, 1], second_axis: [1, 0, 0]}
  guide: {type: prismatic, nodes: [ground, f], axis: [1, 0, 0], preload: 30, position: [0, 0, 0]}
  cam: {type: cam, joints: [shaft, guide], profile: ")yaml" +
           profile + R"yaml(", follower: flat, at: [0, 0, 0], normal: [1, 0, 0]}
drives: {d: {joint: shaft, angle: "40*t"}}
)yaml",
       0.02, 1e-3, "joints/cam/reaction_inertial", 30},
      {"a block that slides and sticks", R"yaml(
gravity: [0, 0, -9.81]
nodes: {b: {position: [0, 0, 0], velocity: [0.0295, 0, 0]}}
elements: {b: {type: rigid_body, node: b, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {p: {type: prismatic, nodes: [ground, b], axis: [1, 0, 0], friction: {coefficient: 0.3, model: stick_slip}}}
)yaml",
       0.02, 1e-3, "joints/p/friction_force", 6},
  };
}

std::vector<double> rows(const std::string& text, double duration, double h, const std::string& dataset) {
  Session session(read_mechanism_text(text, "model.yaml").model);
  MemorySink sink(session.model());
  session.add_sink(sink);
  session.begin_analysis("dynamic");
  DynamicsOptions options;
  options.duration = duration;
  options.stepping.size = h;
  Motion motion = session.dynamics(options);
  REQUIRE(motion.finish());
  const std::vector<double> time = sink.read(0, "time");
  REQUIRE(time.size() == static_cast<std::size_t>(std::lround(duration / h)) + 1);
  for (std::size_t k = 0; k < time.size(); ++k) REQUIRE(time[k] == Approx(static_cast<double>(k) * h).margin(1e-15));
  std::vector<double> values = sink.read(0, dataset);
  session.end_analysis();
  return values;
}

}  // namespace

TEST_CASE("an event at any phase relative to the grid changes reactions by the error of the steps at most") {
  const bielle::test::TemporaryFolder folder;
  const std::string profile = folder.path() + "/eccentric.csv";
  write_eccentric(profile);
  for (const Sample& sample : samples(profile)) {
    const double h = sample.h;
    const std::vector<double> without = rows(sample.text, sample.duration, h, sample.reaction),
                              coarse = rows(sample.text, sample.duration, 2 * h, sample.reaction);
    const std::size_t n = without.size() / (static_cast<std::size_t>(std::lround(sample.duration / h)) + 1);
    double error = 1e-6 * sample.size;  // what accelerations of the shortest steps are good for
    for (std::size_t k = 0; k < coarse.size(); ++k)
      error = std::max(error, std::abs(coarse[k] - without[(k / n) * 2 * n + k % n]));
    for (const char* action : {"note", "restart"}) {
      for (const double away : {0.0, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1.1e-4, 1e-3, 0.03, 0.3, 0.5})
        for (const double side : {-1.0, 1.0}) {
          const double time = 7 * h + side * away * h;
          const std::string event = fmt::format("events: {{e: {{when: \"t\", crosses: {:.17g}, action: {}}}}}\n", time,
                                                action);
          const std::vector<double> with = rows(sample.text + event, sample.duration, h, sample.reaction);
          double worst = 0;
          for (std::size_t k = 0; k < with.size(); ++k) worst = std::max(worst, std::abs(with[k] - without[k]));
          INFO(sample.name << ", " << action << " at " << side * away << " h: " << worst << ", error of steps "
                           << error);
          CHECK(worst <= (std::string(action) == "note" ? 0 : error));
        }
    }
  }
}
