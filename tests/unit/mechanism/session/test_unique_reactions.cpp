// Results name the joints whose reactions redundant constraints leave undetermined.
#include <catch2/catch.hpp>

#include "mechanism/io/run_analyses.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using Catch::Contains;

namespace {

/// A door on two hinges with a handle that hangs on one.
const char* const door = R"yaml(
gravity: [0, 0, -9.81]
nodes: {door: {position: [0.4, 0, 0]}, handle: {position: [0.8, 0, -0.1]}}
elements:
  door: {type: rigid_body, node: door, mass: 20, inertia: [3, 4, 1]}
  handle: {type: rigid_body, node: handle, mass: 1, inertia: [0.01, 0.01, 0.01]}
joints:
  upper: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 0, 0.7]}
  lower: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 0, -0.7]}
  pin: {type: hinge, nodes: [door, handle], axis: [0, 1, 0], position: [0.8, 0, 0]}
analysis: [{type: dynamic, duration: 0.01, step: 1e-3}]
)yaml";

}  // namespace

TEST_CASE("results and summaries name the joints whose reactions are not unique") {
  const MechanismFile file = read_mechanism_text(door, "door.yaml");
  const test::TemporaryFolder folder;
  Progress progress(true);
  run_analyses(file, folder / "door.h5", progress);
  const Hdf5File results = Hdf5File::open(folder / "door.h5");
  const auto unique = [&](const std::string& joint) {
    return results.read("/analysis_1/joints/" + joint + "/reaction_unique");
  };
  CHECK(unique("upper") == std::vector{0.0});
  CHECK(unique("lower") == std::vector{0.0});
  CHECK(unique("pin") == std::vector{1.0});
  // Each hinge carries half of the weight, and the first one in the file does not carry all of it.
  const std::vector<double> upper = results.read("/analysis_1/joints/upper/reaction"),
                            lower = results.read("/analysis_1/joints/lower/reaction");
  CHECK_THAT(upper[2], Catch::WithinRel(lower[2], 1e-8));

  Session session(file.model);
  CHECK_THAT(file.analyses[0]->run(session).text,
             Contains("the reactions of joints 'upper', 'lower' are not unique: the smallest are reported"));
}

TEST_CASE("where nothing is redundant nothing is said") {
  std::string text = door;
  text.erase(text.find("  lower:"), text.find("  pin:") - text.find("  lower:"));
  const MechanismFile file = read_mechanism_text(text, "door.yaml");
  Session session(file.model);
  MemorySink memory(session.model());
  session.add_sink(memory);
  CHECK_THAT(file.analyses[0]->run(session).text, !Contains("unique"));
  CHECK_THROWS_AS(memory.read(0, "joints/pin/reaction_unique"), InputError);
}
