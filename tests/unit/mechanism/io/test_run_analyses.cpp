// The records of whole runs.
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/describe_model.hpp"
#include "mechanism/io/run_analyses.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "mechanism/session/interrupted.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;

TEST_CASE("a static analysis records drives at the time at which it stands, whatever its load factor") {
  const test::TemporaryFolder folder;
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {arm: {position: [0, 0, 0]}, wall: {position: [1, 0, 0], fixed: true}}
elements:
  arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.3, 0.3, 0.5]}
  spring: {type: spring_damper, nodes: [arm, wall], at: [[0, 1, 0], [0, 1, 0]], stiffness: 50, length: 1}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1]}}
drives: {motor: {joint: axle, torque: "4 + 10*t"}}
analysis: [{type: static, steps: 2}]
)yaml",
                                                 "static.yaml");
  const std::string path = folder / "static.h5";
  Progress progress(true);
  run_analyses(file, path, progress);
  const Hdf5File results = Hdf5File::open(path);
  const Eigen::MatrixXd torque = results.read_matrix("/joints/axle/drive_force");
  REQUIRE(torque.size() == 2);
  CHECK(torque(0, 0) == Approx(2));
  CHECK(torque(1, 0) == Approx(4));
}

TEST_CASE(
    "a path records its points with their load factors, names its limit points, and load steps go on from its end") {
  // Von Mises' truss, b = 3, h = 1, 200 N/m: its limit load is 2 k L0 y (1/L - 1/L0) at L^3 = b^2 L0, y^2 = L^2 - b^2.
  const test::TemporaryFolder folder;
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes:
  left: {position: [-3, 0, 0], fixed: true}
  right: {position: [3, 0, 0], fixed: true}
  apex: {position: [0, 1, 0], fixed: [x, z, rx, ry, rz]}
  stage: {fixed: [y, z, rx, ry, rz], motion: {x: "0.5 + t"}}
elements:
  l: {type: spring_damper, nodes: [left, apex], stiffness: 200}
  r: {type: spring_damper, nodes: [right, apex], stiffness: 200}
  load: {type: point_mass, node: stage, mass: 1}
loads: {p: {node: apex, force: [0, -20, 0]}}
analysis:
  - {type: static, arc_length: {until: {node: apex, displacement: -1.9, direction: y}}}
  - {type: static, steps: 2}
  - {type: dynamic, duration: 0.1, step: 0.1}
  - {type: static, steps: 4}
)yaml",
                                                 "truss.yaml");
  const std::string path = folder / "truss.h5";
  Progress progress(true);
  const std::vector<AnalysisSummary> summaries = run_analyses(file, path, progress);
  const double L0 = std::sqrt(10.0), L = std::cbrt(9 * L0), y = std::sqrt(L * L - 9);
  const double limit = 2 * 200 * L0 * y * (1 / L - 1 / L0) / 20;
  const std::vector<double> limits = summaries.front().numbers.at("limit_points");
  REQUIRE(limits.size() == 2);
  CHECK(limits[0] == Approx(limit).epsilon(1e-9));
  CHECK(limits[1] == Approx(-limit).epsilon(1e-9));
  CHECK_THAT(
      format_summary(file, summaries, {}, path),
      Catch::Contains("static, arc length") && Catch::Contains(fmt::format("limit point at load factor {:.6}", limit)));
  const Hdf5File results = Hdf5File::open(path);
  const auto column = [&](const std::string& name, Eigen::Index k) {
    return Eigen::VectorXd(results.read_matrix(name).col(k));
  };
  const Eigen::VectorXd factor = results.read_vector("/analysis_1/time"),
                        apex = column("/analysis_1/nodes/apex/position", 1),
                        stage = column("/analysis_1/nodes/stage/position", 0);
  REQUIRE(factor.size() == summaries.front().records);
  for (Eigen::Index k = 0; k < factor.size(); ++k) {
    CHECK(20 * factor[k] == Approx(400 * L0 * apex[k] * (1 / std::hypot(3, apex[k]) - 1 / L0)).margin(1e-7));
    CHECK(stage[k] == Approx(0.5 * factor[k]).margin(1e-12));
  }
  CHECK(apex[factor.size() - 1] == Approx(-0.9).margin(1e-11));
  const double end = factor[factor.size() - 1];
  const Eigen::VectorXd second = results.read_vector("/analysis_2/time"),
                        moved = column("/analysis_2/nodes/stage/position", 0);
  REQUIRE(second.size() == 2);
  CHECK(second[0] == Approx(0.5 * (1 + end)));
  CHECK(second[1] == 1);
  CHECK(moved[1] == Approx(0.5));
  // After the motion the full loads act, and the stage is at the position that its motion prescribes for that time.
  const Eigen::VectorXd last = results.read_vector("/analysis_4/time");
  REQUIRE(last.size() == 1);
  CHECK(last[0] == 1);
  CHECK(column("/analysis_4/nodes/stage/position", 0)[0] == Approx(0.6));
  CHECK(column("/analysis_4/nodes/apex/position", 1)[0] ==
        Approx(column("/analysis_2/nodes/apex/position", 1)[1]).margin(1e-8));
}

TEST_CASE("two drives on one joint move its two coordinates, and record their forces side by side") {
  // A shaft of 2 kg and 0.5 kg m^2 that is turned and pushed along its axis, against its weight.
  const test::TemporaryFolder folder;
  const MechanismFile file = read_mechanism_text(R"yaml(
gravity: [0, 0, -10]
nodes: {shaft: {position: [0, 0, 0]}}
elements: {shaft: {type: rigid_body, node: shaft, mass: 2, inertia: [0.3, 0.3, 0.5]}}
joints: {sleeve: {type: cylindrical, nodes: [ground, shaft], axis: [0, 0, 1]}}
drives:
  motor: {joint: sleeve, angle: "4*t^2"}
  lift: {joint: sleeve, displacement: "3*t^2"}
analysis: [{type: dynamic, duration: 0.5, step: 0.01}]
)yaml",
                                                 "shaft.yaml");
  const std::string path = folder / "shaft.h5";
  Progress progress(true);
  run_analyses(file, path, progress);
  const Hdf5File results = Hdf5File::open(path);
  const Eigen::MatrixXd coordinates = results.read_matrix("/joints/sleeve/coordinate");
  const Eigen::MatrixXd forces = results.read_matrix("/joints/sleeve/drive_force");
  REQUIRE(forces.rows() == 51);
  // Both laws are quadratic, for which the scheme is exact.
  CHECK(coordinates(50, 0) == Approx(0.75));
  CHECK(coordinates(50, 1) == Approx(1));
  for (const Eigen::Index row : {1, 25, 50}) {
    CHECK(forces(row, 0) == Approx(2 * (10 + 6)).epsilon(1e-8));
    CHECK(forces(row, 1) == Approx(0.5 * 8).epsilon(1e-8));
  }
}

TEST_CASE("repeated joints are summed up by joint; a mechanism at rest gives no warning") {
  const test::TemporaryFolder folder;
  const MechanismFile file = read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  front: {type: hinge, nodes: [ground, arm], position: [0, 0, 0.2], axis: [0, 1, 0]}
  rear: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 1, 0]}
analysis: [{type: dynamic, duration: 0.1, step: 0.01}]
)yaml",
                                                 "blocked.yaml");
  const std::string path = folder / "blocked.h5";
  Progress progress(true);
  const std::vector<AnalysisSummary> summaries = run_analyses(file, path, progress);
  const std::string summary = format_summary(file, summaries, {}, path);
  using Catch::Contains;
  CHECK_THAT(summary, Contains("redundant: y, z, rx, ry of joint 'rear'; set aside"));
  CHECK_THAT(summary, !Contains("warning:"));
}

TEST_CASE("given times are recorded exactly, on the motion between the steps") {
  // A mass thrown along x, with fixed and with adaptive steps that meet none of the times but one.
  for (const std::string steps : {"step: 0.1", "step: 0.1, tolerance: 1e-6"}) {
    const test::TemporaryFolder folder;
    const MechanismFile file = read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes: {m: {position: [0, 0, 0], velocity: [3, 0, 5], fixed: [rx, ry, rz]}}
elements: {m: {type: point_mass, node: m, mass: 2}}
output: {times: [0.05, 0.3, 0.333, 0.777]}
analysis: [{type: dynamic, duration: 0.5, )yaml" + steps +
                                                       "}, {type: dynamic, duration: 0.5, " + steps + "}]\n",
                                                   "times.yaml");
    const std::string path = folder / "times.h5";
    Progress progress(true);
    run_analyses(file, path, progress);
    const Hdf5File results = Hdf5File::open(path);
    const std::vector<std::vector<double>> expected = {{0, 0.05, 0.3, 0.333}, {0.5, 0.777}};
    for (const int analysis : {0, 1}) {
      const std::string group = "/analysis_" + std::to_string(analysis + 1);
      const std::vector<double>& times = expected[static_cast<std::size_t>(analysis)];
      REQUIRE(results.read(group + "/time") == times);
      const Eigen::MatrixXd x = results.read_matrix(group + "/nodes/m/position");
      const Eigen::MatrixXd v = results.read_matrix(group + "/nodes/m/velocity");
      const std::vector<double> balance = results.read(group + "/energy/balance");
      for (std::size_t k = 0; k < times.size(); ++k) {
        const double t = times[k];
        const auto row = static_cast<Eigen::Index>(k);
        // The scheme and the interpolation are exact for constant acceleration.
        CHECK(x(row, 0) == Approx(3 * t).margin(1e-12));
        CHECK(x(row, 2) == Approx(5 * t - 9.81 * t * t / 2).margin(1e-12));
        CHECK(v(row, 2) == Approx(5 - 9.81 * t).margin(1e-11));
        CHECK(balance[k] == Approx(0).margin(1e-10));
      }
    }
  }
}

namespace {

/// Returns a double pendulum: constraints, turns of joints, a push with kinks, and two motions one after the other.
std::string pendulum(const std::string& steps, double duration, const std::string& output) {
  return R"yaml(
gravity: [0, 0, -9.81]
nodes:
  upper: {position: [0.5, 0, 0]}
  lower: {position: [1.5, 0, 0], angular_velocity: [0, 30, 0], velocity: [0, 0, -15]}
elements:
  upper: {type: rigid_body, node: upper, mass: 2, inertia: [0.01, 0.2, 0.2]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.01, 0.1, 0.1]}
joints:
  shoulder: {type: hinge, nodes: [ground, upper], position: [0, 0, 0], axis: [0, 1, 0]}
  elbow: {type: hinge, nodes: [upper, lower], position: [1, 0, 0], axis: [0, 1, 0]}
loads: {push: {node: lower, force: ["20*pulse(t, 0.1234, 0.3)", 0, 0]}}
output: {)yaml" +
         output + "}\nanalysis:\n  - {type: dynamic, duration: 0.2, " + steps +
         "}\n  - {type: dynamic, duration: " + std::to_string(duration) + ", " + steps + "}\n";
}

void run(const std::string& text, const std::string& path, const std::string& restart = "") {
  Progress progress(true);
  const MechanismFile file = read_mechanism_text(text, "pendulum.yaml");
  run_analyses(file, path, progress, restart);
}

void check_same_results(const Hdf5File& a, const Hdf5File& b, const std::string& group) {
  REQUIRE(a.names_in(group) == b.names_in(group));
  for (const std::string& name : a.names_in(group)) {
    const std::string object = group + "/" + name;
    if (a.is_group(object)) {
      check_same_results(a, b, object);
    } else {
      INFO(object);
      CHECK(a.read(object) == b.read(object));
    }
  }
}

}  // namespace

TEST_CASE(
    "a run that goes on from a checkpoint gives the numbers of the run that was not interrupted, to the last bit") {
  for (const std::string steps : {"step: 1e-3", "step: 1e-3, tolerance: 1e-6"}) {
    const test::TemporaryFolder folder;
    const std::string whole = folder / "whole.h5", part = folder / "part.h5", rest = folder / "rest.h5";
    run(pendulum(steps, 0.4, "every: 3, checkpoint: 30"), whole);
    // Cut off within the second motion, in between two checkpoints: its rows after the last one are taken back.
    {
      const std::string text = pendulum(steps, 0.4, "every: 3, checkpoint: 30");
      std::filesystem::copy_file(whole, part);
      Hdf5File file = Hdf5File::open_to_extend(part);
      const std::size_t count = file.shape("/checkpoints/analysis_2/rows")[0];
      REQUIRE(count > 3);
      file.truncate_rows("/checkpoints/analysis_2/rows", count / 2);
      file.close();
      run(text, rest, part);
    }
    const Hdf5File a = Hdf5File::open(whole), b = Hdf5File::open(rest);
    for (const std::string group : {"/analysis_1", "/analysis_2", "/checkpoints/analysis_1", "/checkpoints/analysis_2"})
      check_same_results(a, b, group);
    CHECK(b.read_integer_attribute("/", "complete") == 1);
    CHECK(b.read("/time").back() == Approx(0.6));
  }
}

TEST_CASE("a Campbell diagram that is interrupted keeps the speeds that were computed") {
  const std::string text = R"yaml(
nodes: {rotor: {}, bob: {position: [1, 0, 0]}}
elements:
  rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.1, 0.1, 0.2]}
  bob: {type: rigid_body, node: bob, mass: 1, inertia: [0.01, 0.01, 0.02]}
joints:
  axle: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1]}
  blade: {type: hinge, nodes: [rotor, bob], axis: [0, 1, 0], position: [0.1, 0, 0], stiffness: 100}
analysis: [{type: campbell, rotation: {joint: axle}, speeds: {from: 1, to: 10, count: 10}, modes: 1}]
)yaml";
  const test::TemporaryFolder folder;
  const MechanismFile file = read_mechanism_text(text, "rotor.yaml");
  Progress progress(true);
  const auto run_until = [&](int calls, const std::string& path) {
    RunListener listener;
    listener.on_step = [&calls](Session&) {
      if (calls-- == 0) throw Interrupted("interrupted");
    };
    run_analyses(file, path, progress, "", 1, listener);
  };
  const std::string whole = folder / "whole.h5", part = folder / "part.h5", none = folder / "none.h5";
  run_until(-1, whole);
  const std::vector<double> speeds = Hdf5File::open(whole).read("/analysis_1/campbell/speed"),
                            frequencies = Hdf5File::open(whole).read("/analysis_1/campbell/frequency");
  REQUIRE(speeds.size() == 10);
  CHECK(test::message_of<Interrupted>([&] { run_until(4, part); }) ==
        "interrupted after 4 of 10 speeds; the results file holds these, and nothing of the others");
  const Hdf5File results = Hdf5File::open(part);
  CHECK(results.read_integer_attribute("/", "complete") == 0);
  CHECK(results.read("/analysis_1/campbell/speed") == std::vector<double>(speeds.begin(), speeds.begin() + 4));
  CHECK(results.read("/analysis_1/campbell/frequency") ==
        std::vector<double>(frequencies.begin(), frequencies.begin() + 4));
  CHECK(test::message_of<Interrupted>([&] { run_until(0, none); }) == "interrupted after 0 of 10 speeds");
}

TEST_CASE("an analysis names the place that it has reached") {
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {a: {fixed: [y, z, rx, ry, rz]}}
elements:
  a: {type: point_mass, node: a, mass: 1}
  spring: {type: spring_damper, nodes: [ground, a], at: [[-1, 0, 0], [0, 0, 0]], stiffness: 10}
loads: {push: {node: a, force: [1, 0, 0]}}
analysis: [{type: static, steps: 4}, {type: dynamic, duration: 0.2, step: 0.1}]
)yaml",
                                                 "spring.yaml");
  std::vector<std::string> places;
  std::size_t present = 0;
  Session session(file.model, 1);
  session.on_step([&](Session& at) { places.push_back(file.analyses[present]->place(at)); });
  for (; present < file.analyses.size(); ++present) file.analyses[present]->run(session);
  CHECK(places == std::vector<std::string>{"load factor 0.25", "load factor 0.5", "load factor 0.75", "load factor 1",
                                           "t = 0.1 s", "t = 0.2 s"});
}

TEST_CASE("a finished motion goes on in its own file when its duration has grown") {
  const test::TemporaryFolder folder;
  const std::string whole = folder / "whole.h5", grown = folder / "grown.h5";
  run(pendulum("step: 1e-3", 0.4, "every: 5, checkpoint: 200"), whole);
  run(pendulum("step: 1e-3", 0.2, "every: 5, checkpoint: 200"), grown);
  run(pendulum("step: 1e-3", 0.4, "every: 5, checkpoint: 200"), grown, grown);
  const Hdf5File a = Hdf5File::open(whole), b = Hdf5File::open(grown);
  const std::vector<double> x = a.read("/nodes/lower/position"), y = b.read("/nodes/lower/position");
  REQUIRE(x.size() == y.size());
  for (std::size_t k = 0; k < x.size(); ++k) CHECK(y[k] == Approx(x[k]).margin(1e-9));
}

TEST_CASE("a motion may go on with other steps than it began with") {
  const test::TemporaryFolder folder;
  for (const auto& [first, then] :
       {std::pair("step: 1e-3", "step: 1e-3, tolerance: 1e-6"), std::pair("step: 1e-3, tolerance: 1e-6", "step: 1e-3"),
        std::pair("step: 1e-3", "step: 5e-4, rho: 0.6")}) {
    const std::string results = folder / "results.h5";
    run(pendulum(first, 0.2, "every: 5"), results);
    run(pendulum(then, 0.3, "every: 5"), results, results);
    CHECK(Hdf5File::open(results).read("/time").back() == Approx(0.5));
  }
}

TEST_CASE("what cannot be continued is refused, and the file stays as it was") {
  const test::TemporaryFolder folder;
  const std::string results = folder / "results.h5";
  run(pendulum("step: 1e-2", 0.1, "every: 1"), results);
  const auto refusal = [&](const std::string& text, const std::string& from) {
    return test::message_of<InputError>([&] { run(text, results, from); });
  };
  std::string other = pendulum("step: 1e-2", 0.1, "every: 1");
  other.replace(other.find("shoulder"), 8, "hip");
  CHECK_THAT(refusal(other, results), Catch::Contains("another model: hinge 'hip' differs"));
  other = pendulum("step: 1e-2", 0.1, "every: 1");
  other.replace(other.find("mass: 2"), 7, "mass: 3");
  CHECK_THAT(refusal(other, results), Catch::Contains("another model: rigid_body 'upper' differs"));
  CHECK_THAT(refusal(pendulum("step: 1e-2", 0.1, "every: 1"), folder / "none.h5"), Catch::Contains("none.h5"));
  CHECK(Hdf5File::open(results).read_integer_attribute("/", "complete") == 1);
}

TEST_CASE("results take the place of results only") {
  const test::TemporaryFolder folder;
  const std::string text = pendulum("step: 1e-2", 0.1, "every: 1"), path = folder / "arm.yaml";
  {
    std::ofstream model(path);
    model << text;
  }
  CHECK_THAT(test::message_of<InputError>([&] { run(text, path); }), Catch::Contains("arm.yaml: exists"));
  const std::string body = folder / "link.h5";
  Hdf5File::create(body).write_attribute("/", "format", std::string("bielle superelement"));
  CHECK_THAT(test::message_of<InputError>([&] { run(text, body); }), Catch::Contains("no results file"));
  const std::string results = folder / "arm.h5";
  run(text, results);
  run(text, results);
}

TEST_CASE("what `only` does not name is not recorded, and the rest is as without it") {
  const test::TemporaryFolder folder;
  const std::string steps = "step: 1e-3", whole = folder / "whole.h5", part = folder / "part.h5";
  run(pendulum(steps, 0.1, "every: 10"), whole);
  run(pendulum(steps, 0.1, "every: 10, only: {nodes: [lower], joints: []}"), part);
  const Hdf5File a = Hdf5File::open(whole), b = Hdf5File::open(part);
  CHECK(b.names_in("/nodes") == std::vector<std::string>{"lower"});
  CHECK_FALSE(b.has("/joints"));
  for (const std::string group : {"/analysis_2/nodes/lower", "/analysis_2/elements", "/analysis_2/energy"})
    check_same_results(a, b, group);

  for (const std::string other : {"every: 10", "every: 10, only: {nodes: [upper, lower], joints: []}",
                                  "every: 10, only: {nodes: [lower], joints: [], elements: [upper]}"}) {
    INFO(other);
    CHECK_THROWS_WITH(run(pendulum(steps, 0.2, other), folder / "rest.h5", part),
                      Catch::Contains("goes on with the outputs that it began with"));
  }
}

TEST_CASE("slips in `only` are told") {
  const auto message = [](const std::string& only) {
    return test::message_of<InputError>([&] { read_mechanism_text(pendulum("step: 1e-3", 1, only), "p.yaml"); });
  };
  CHECK_THAT(message("only: {nodes: [lowr]}"), Catch::Contains("'lowr'") && Catch::Contains("did you mean 'lower'"));
  CHECK_THAT(message("only: {nods: [lower]}"), Catch::Contains("did you mean 'nodes'"));
  CHECK_THAT(message("only: {joints: [elbow, elbow]}"), Catch::Contains("is named twice"));
  CHECK_THAT(message("only: {elements: [upper]}, fields: {lower: [stress]}"), Catch::Contains("leaves out 'lower'"));
}

TEST_CASE("a run without a file tells its listener all that a file would hold") {
  const test::TemporaryFolder folder;
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {arm: {}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1], stiffness: 3, start: 0.2}}
analysis: [{type: dynamic, duration: 1, step: 0.3}]
output: {log: true}
)yaml",
                                                 "wheel.yaml");
  struct Said : Notes {
    void note(const std::string& sentence) override { sentences.push_back(sentence); }
    std::vector<std::string> sentences;
  } said;
  MemorySink memory(file.model);
  int steps = 0;
  Progress quiet(true);
  const std::vector<AnalysisSummary> summaries =
      run_analyses(file, "", quiet, "", 1, {&memory, &said, [&](Session&) { ++steps; }});
  const std::string path = folder / "wheel.h5";
  run_analyses(file, path, quiet);
  const Eigen::MatrixXd written = Hdf5File::open(path).read_matrix("/joints/axle/coordinate");
  const std::vector<double> kept = memory.read(0, "joints/axle/coordinate");
  REQUIRE(kept.size() == static_cast<std::size_t>(written.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) CHECK(kept[k] == written(static_cast<Eigen::Index>(k), 0));
  CHECK(steps == 4);
  CHECK(summaries.at(0).records == 5);
  REQUIRE(said.sentences.size() == 2);
  CHECK_THAT(said.sentences[0], Catch::Contains("no results file to write the log"));
  CHECK_THAT(said.sentences[1], Catch::Contains("0.25 s in place of 0.3 s"));
  CHECK_THROWS_AS(run_analyses(file, "", quiet, path), InputError);
}
