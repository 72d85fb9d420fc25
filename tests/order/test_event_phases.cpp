// The law of events: a crossing without consequences leaves motions and reactions unchanged, to the order of the
// scheme, at any position relative to the grid of steps: on a time of it, and from 1e-16 s to a whole step before and
// behind.
//
// Such a crossing is noted within a step, or (`action: restart`) ends the step, so that the remaining step has any
// size. The change is compared with that of steps of twice the size.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::mechanism;

namespace {

struct Sample {
  const char* name;
  std::string text;
  double duration, h;
  const char* reaction;  ///< the dataset that is compared
  double size;           ///< scale of the reactions [N] or [N m]
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
nodes: {b: {position: [0, 0, 0.097], velocity: [1, 0, 0]}}
elements: {b: {type: rigid_body, node: b, mass: 2, inertia: [0.01, 0.01, 0.01]}}
joints:
  c:
    type: contact
    shapes: [{node: ground, plane: [0, 0, 1]}, {node: b, sphere: 0.1}]
    stiffness: 1e5
    restitution: 0.5
)yaml",
       0.02, 1e-3, "contacts/c/force", 20},
      {"a body pressed against a stop", R"yaml(
gravity: [0, 0, -9.81]
nodes: {b: {position: [0, 0, 0]}}
elements: {b: {type: rigid_body, node: b, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {path: {type: prismatic, nodes: [ground, b], axis: [0, 0, -1], stops: {range: [~, 0.0005], stiffness: 1800, damping: 12}}}
)yaml",
       0.04, 1e-3, "joints/path/stop_force", 20},
      {"a flat follower on an eccentric",
       R"yaml(
nodes: {c: {position: [0, 0, 0], angular_velocity: [0, 0, 40]}, b: {position: [0.05, 0, 0]}}
elements:
  c: {type: rigid_body, node: c, mass: 1, inertia: [0.01, 0.01, 0.01]}
  b: {type: rigid_body, node: b, mass: 0.5, inertia: [0.01, 0.01, 0.01]}
joints:
  shaft: {type: hinge, nodes: [ground, c], axis: [0, 0, 1], second_axis: [1, 0, 0]}
  guide: {type: prismatic, nodes: [ground, b], axis: [1, 0, 0], preload: 30, position: [0, 0, 0]}
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
       0.02, 1e-3, "joints/p/friction", 6},
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
    std::vector<double> by_restarts;  // at each size of steps
    for (const double h : {sample.h, sample.h / 2}) {
      const std::vector<double> without = rows(sample.text, sample.duration, h, sample.reaction),
                                coarse = rows(sample.text, sample.duration, 2 * h, sample.reaction);
      const std::size_t n = without.size() / (static_cast<std::size_t>(std::lround(sample.duration / h)) + 1);
      // The error of steps of 2 h is 4/3 of the difference between results with 2 h and with h.
      double error = 1e-6 * sample.size;  // accuracy of the accelerations of the shortest steps
      for (std::size_t k = 0; k < coarse.size(); ++k)
        error = std::max(error, 4.0 / 3 * std::abs(coarse[k] - without[(k / n) * 2 * n + k % n]));
      by_restarts.push_back(0);
      for (const char* action : {"note", "restart"})
        for (const double away : {0.0, 1e-16, 1e-13, 1e-10, 1e-7, 1e-5, 1.1e-4, 1e-3, 9e-3, 0.011, 0.1, 0.3, 0.5})
          for (const double side : {-1.0, 1.0}) {
            const std::string event =
                fmt::format("events: {{e: {{when: \"t + 0*b.position.x\", crosses: {:.17g}, action: {}}}}}\n",
                            0.4 * sample.duration + side * away * h, action);
            const std::vector<double> with = rows(sample.text + event, sample.duration, h, sample.reaction);
            double worst = 0;
            for (std::size_t k = 0; k < with.size(); ++k) worst = std::max(worst, std::abs(with[k] - without[k]));
            INFO(sample.name << ", h = " << h << ", " << action << " at " << side * away << " h: " << worst
                             << ", error of steps " << error);
            // A restart causes errors of its own, which are of the same order.
            CHECK(worst <= (std::string(action) == "note" ? 0 : 2 * error));
            by_restarts.back() = std::max(by_restarts.back(), worst);
          }
    }
    // The change is of order 2, above the rounding of the shortest steps.
    INFO(sample.name << ": " << by_restarts[0] << " -> " << by_restarts[1]);
    CHECK(by_restarts[1] <= by_restarts[0] / 3 + 1e-6 * sample.size);
  }
}

TEST_CASE(
    "a body on a turning arm pulls with m r omega^2, also where a place is passed just behind a time of the grid") {
  constexpr double pull = 123.37005501361698;  // 1 kg, 0.5 m, 5 pi rad/s
  for (const char* drive : {"", "drives: {d: {joint: s, angle: \"15.70796326794897*t\"}}\n"})
    for (const char* beyond : {"0", "3e-13", "1e-9", "1e-7", "2e-5"})
      for (const char* action : {"note", "restart"})
        for (const double h : {5e-4, 1e-3, 2e-3}) {
          // At a quarter of a turn, 0.1 s.
          const std::string event = fmt::format(
              "events: {{z: {{when: \"b.position.x + {}\", direction: falling, action: {}}}}}\n", beyond, action);
          Session session(read_mechanism_text(arm + drive + event, "model.yaml").model);
          std::vector<Event> events;
          session.on_event([&](const Event& passed) { events.push_back(passed); });
          double worst = 0;
          session.on_step([&](Session&) {
            const std::vector<double> reaction = session.read("joints/s/reaction_inertial");
            worst = std::max(worst, std::abs(std::hypot(reaction[0], reaction[1], reaction[2]) / pull - 1));
          });
          DynamicsOptions options;
          options.duration = 0.12;
          options.stepping.size = h;
          Motion motion = session.dynamics(options);
          REQUIRE(motion.finish());
          INFO(drive << beyond << ", " << action << ", h = " << h);
          CHECK(worst < std::pow(15.7 * h, 2) / 2);  // without the event: 0.34 (omega h)^2 driven, 0.08 free
          REQUIRE(events.size() == 1);
          CHECK(events[0].time == Approx(0.1).margin(2e-5 / 7.85 + 0.1 * std::pow(15.7 * h, 2) / 4).epsilon(0));
        }
}
