// What whole runs record.
#include <catch2/catch.hpp>

#include "mechanism/io/run_analyses.hpp"
#include "reduce/common/hdf5_file.hpp"
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
