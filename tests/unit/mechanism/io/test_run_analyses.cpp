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
