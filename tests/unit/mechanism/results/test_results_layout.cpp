// The stacked layout contains the same values as the layout by names, bit for bit, for any model.
#include <cmath>
#include <filesystem>

#include "results_sample.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/io/run_analyses.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::message_of;
using Catch::Contains;

namespace test_results_layout {
namespace {

/// Two hinges alike and one that is driven; bodies, two beams of one element and one of two; a door that hangs on two
/// hinges, one of which is locked for a while; a measure.
const char* const model_text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  a: {position: [0.5, 0, 0]}
  b: {position: [1.5, 0, 0]}
  c: {position: [2.5, 0, 0]}
  tip: {position: [3, 0, 0]}
  door: {position: [0.4, 1, 0]}
  b1: {position: [0, 2, 0], fixed: true}
  b2: {position: [1, 2, 0]}
  b3: {position: [2, 2, 0]}
  b4: {position: [3, 2, 0]}
elements:
  a: {type: rigid_body, node: a, mass: 2, inertia: [0.01, 0.2, 0.2]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.01, 0.1, 0.1]}
  c: {type: rigid_body, node: c, mass: 1, inertia: [0.01, 0.1, 0.1]}
  door: {type: rigid_body, node: door, mass: 20, inertia: [3, 4, 1]}
  weight: {type: point_mass, node: tip, mass: 0.1}
  first: {type: beam, nodes: [b1, b2], elements: 1, section: {circle: 0.02, young: 2.1e9, poisson: 0.3, density: 7800}}
  second: {type: beam, nodes: [b2, b3], elements: 1, section: {circle: 0.02, young: 2.1e9, poisson: 0.3, density: 7800}}
  third: {type: beam, nodes: [b3, b4], elements: 2, section: {circle: 0.02, young: 2.1e9, poisson: 0.3, density: 7800}}
joints:
  shoulder: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [0, 1, 0]}
  elbow: {type: hinge, nodes: [a, b], position: [1, 0, 0], axis: [0, 1, 0]}
  wrist: {type: hinge, nodes: [b, c], position: [2, 0, 0], axis: [0, 1, 0]}
  end: {type: rigid, nodes: [c, tip]}
  upper: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 1, 0.7], locked: {to: 0.005}}
  lower: {type: hinge, nodes: [ground, door], axis: [0, 0, 1], position: [0, 1, -0.7]}
drives: {motor: {joint: elbow, torque: "3*sin(20*t)"}}
measures: {bent: elbow.angle, height: {node: tip, quantity: position, direction: z}}
OUTPUT
analysis: [{type: dynamic, duration: 0.02, step: 1e-3}]
)yaml";

MechanismFile read(const std::string& output) {
  std::string text = model_text;
  text.replace(text.find("OUTPUT"), 6, output.empty() ? "" : "output: {" + output + "}");
  return read_mechanism_text(text, "model.yaml");
}

void run(const std::string& output, const std::string& path, const std::string& restart = "") {
  Progress progress(true);
  run_analyses(read(output), path, progress, restart);
}

/// Returns the values in the stacked file for a name of the layout by names: "joints/elbow/rate".
std::vector<double> by_name(const Hdf5File& file, const ResultsKinds& kinds, const ResultsEntry& entry,
                            const ResultsField& field) {
  const ResultsKind& kind = kinds.kinds()[entry.kind];
  const std::string place = fmt::format("/{}/{}", section_name(kind.section), kind.name);
  const std::vector<std::string> names = file.read_names(place + "/name");
  REQUIRE(names.at(entry.number) == entry.entry.name);
  const Shape shape = file.shape(place + "/" + field.name);
  REQUIRE(shape.at(1) == names.size());
  const std::vector<double> all = file.read(place + "/" + field.name);
  std::vector<double> values;
  for (std::size_t row = 0; row < shape[0]; ++row) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>((row * names.size() + entry.number) * field.size);
    values.insert(values.end(), begin, begin + static_cast<std::ptrdiff_t>(field.size));
  }
  return values;
}

void check_equal(const Hdf5File& named, const Hdf5File& stacked, const Model& model) {
  const ResultsRows rows(model);
  for (const char* total : {"/time", "/energy/kinetic", "/energy/balance", "/solver/newton_iterations"})
    CHECK(named.read(total) == stacked.read(total));
  for (const ResultsEntry& entry : rows.kinds().entries()) {
    const ResultsKind& kind = rows.kinds().kinds()[entry.kind];
    for (const ResultsField& field : kind.fields) {
      const std::string dataset = rows.kinds().dataset(entry, field);
      CAPTURE(dataset);
      CHECK(by_name(stacked, rows.kinds(), entry, field) == named.read("/" + dataset));
      const std::string place = results_path({kind.section, kind.name});
      CHECK(stacked.units(fmt::format("/{}/{}", place, field.name)) == named.units("/" + dataset));
    }
  }
}

}  // namespace

TEST_CASE("both layouts hold the same numbers, bit for bit, and memory has them by the same names") {
  const test::TemporaryFolder folder;
  run("layout: named", folder / "named.h5");
  run("layout: stacked", folder / "stacked.h5");
  run("", folder / "small.h5");
  const MechanismFile file = read("");
  const Hdf5File named = Hdf5File::open(folder / "named.h5"), stacked = Hdf5File::open(folder / "stacked.h5");
  CHECK(named.read_text_attribute("/", "layout") == "named");
  CHECK(named.read_integer_attribute("/", "version") == 1);
  CHECK(stacked.read_text_attribute("/", "layout") == "stacked");
  CHECK(stacked.read_integer_attribute("/", "version") == 2);
  CHECK(Hdf5File::open(folder / "small.h5").read_text_attribute("/", "layout") == "named");
  check_equal(named, stacked, file.model);

  Session session(file.model);
  MemorySink memory(file.model);
  session.add_sink(memory);
  file.analyses[0]->run(session);
  for (const ResultsColumn& column : memory.columns()) {
    CAPTURE(column.dataset);
    CHECK(memory.read(0, column.dataset) == named.read("/" + column.dataset));
    CHECK(session.read(column.dataset).size() == column.size);
  }
  CHECK(session.read("measures/bent") == session.read("joints/elbow/coordinate"));
}

TEST_CASE("entries that record the same are one kind, with their names and attributes as lists") {
  const test::TemporaryFolder folder;
  run("layout: stacked", folder / "run.h5");
  const Hdf5File file = Hdf5File::open(folder / "run.h5");
  using Names = std::vector<std::string>;
  CHECK(file.names_in("/nodes") == Names{"node"});
  CHECK(file.shape("/nodes/node/position") == Shape{21, 9, 3});
  CHECK(file.read_names("/elements/rigid_body/name") == Names{"a", "b", "c", "door"});
  CHECK(file.read_names("/elements/rigid_body/attributes/mass")[1] == "1");
  CHECK(file.read_names("/elements/beam/name") == Names{"first", "second"});
  CHECK(file.shape("/elements/beam/position") == Shape{21, 2, 2, 3});
  CHECK(file.read_names("/elements/beam_2/name") == Names{"third"});
  CHECK(file.shape("/elements/beam_2/strain") == Shape{21, 1, 2, 6});
  CHECK(file.read_text_attribute("/elements/beam_2", "type") == "beam");
  CHECK(file.read_names("/joints/hinge/name") == Names{"shoulder", "wrist", "lower"});
  CHECK(file.read_names("/joints/hinge/attributes/second_node") == Names{"a", "c", "door"});
  CHECK(file.read_names("/joints/hinge_2/name") == Names{"elbow"});
  CHECK(file.shape("/joints/hinge_2/drive_force") == Shape{21, 1, 1});
  CHECK(file.read("/joints/hinge/reaction_unique") == std::vector<double>{1, 1, 0});
  CHECK(file.units("/joints/hinge/reaction_unique") == "-");
  CHECK(file.read("/joints/hinge_3/reaction_unique") == std::vector<double>{0});
}

TEST_CASE("`only` leaves entries out of both layouts") {
  const test::TemporaryFolder folder;
  const std::string only = ", only: {nodes: [tip], joints: [wrist, elbow]}";
  run("layout: named" + only, folder / "named.h5");
  run("layout: stacked" + only, folder / "stacked.h5");
  const MechanismFile file = read("layout: stacked" + only);
  const Hdf5File named = Hdf5File::open(folder / "named.h5"), stacked = Hdf5File::open(folder / "stacked.h5");
  CHECK(named.names_in("/nodes") == std::vector<std::string>{"tip"});
  CHECK(stacked.read_names("/nodes/node/name") == std::vector<std::string>{"tip"});
  CHECK_FALSE(stacked.has("/joints/rigid"));
  check_equal(named, stacked, file.model);
}

TEST_CASE("a restart in the stacked layout goes on as if nothing had happened") {
  const test::TemporaryFolder folder;
  const std::string output = "layout: stacked, checkpoint: 7";
  const MechanismFile file = read(output);
  {
    // The file of a run that is killed after some rows that no checkpoint counts.
    Session session(file.model);
    ResultsFile results(folder / "whole.h5", file.model, file.text, file.output.layout);
    results.name_equations(session.system());
    session.add_sink(results);
    session.set_recording(file.output.recording);
    session.on_step([&](Session& at) {
      if (std::abs(at.time() - 0.017) > 1e-9) return;
      results.file();  // waits for the rows
      std::filesystem::copy_file(folder / "whole.h5", folder / "run.h5");
    });
    file.analyses[0]->run(session);
    results.complete();
  }
  CHECK(Hdf5File::open(folder / "run.h5").shape("/time") == Shape{18});
  Progress progress(true);
  run_analyses(file, folder / "run.h5", progress, folder / "run.h5");
  const Hdf5File whole = Hdf5File::open(folder / "whole.h5"), again = Hdf5File::open(folder / "run.h5");
  CHECK(again.read_integer_attribute("/", "complete") == 1);
  const ResultsRows rows(file.model);
  for (const ResultsColumn& column : rows.columns(ResultsLayout::stacked)) {
    CAPTURE(column.dataset);
    CHECK(again.shape("/" + column.dataset) == whole.shape("/" + column.dataset));
    CHECK(again.read("/" + column.dataset) == whole.read("/" + column.dataset));
  }
  CHECK(again.read_names("/joints/hinge/attributes/first_node") ==
        whole.read_names("/joints/hinge/attributes/first_node"));
}

TEST_CASE("a run goes on with the layout and the outputs that it began with") {
  const test::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  const auto refusal = [&](const std::string& output) {
    return message_of<InputError>([&] { run(output + ", checkpoint: 7", folder / "other.h5", path); });
  };
  run("layout: stacked, checkpoint: 7", path);
  CHECK_THAT(refusal("layout: named"), Contains("has the layout 'stacked', and the model asks for 'named'"));
  CHECK_THAT(refusal("only: {nodes: [tip]}"), Contains("holds 'nodes/a', which `only` leaves out now"));
  CHECK_THAT(refusal("only: {joints: [shoulder, lower, upper, elbow, end]}"),
             Contains("holds 'joints/wrist', which `only` leaves out now"));
  std::string longer = read("checkpoint: 7").text;
  longer.replace(longer.find("duration: 0.02"), 14, "duration: 0.03");
  Progress progress(true);
  run_analyses(read_mechanism_text(longer, "model.yaml"), folder / "follows.h5", progress, path);
  const Hdf5File follows = Hdf5File::open(folder / "follows.h5");
  CHECK(follows.read_text_attribute("/", "layout") == "stacked");
  CHECK(follows.read("/joints/hinge/reaction_unique") == std::vector<double>{1, 1, 0});  // taken out and said again
  run("layout: stacked, only: {nodes: [tip]}, checkpoint: 7", path);
  CHECK_THAT(refusal("layout: stacked"), Contains("'nodes/a' is not in it"));
  run("checkpoint: 7", path);
  CHECK_THAT(refusal("layout: stacked"), Contains("has the layout 'named', and the model asks for 'stacked'"));
}

TEST_CASE("a wrong layout brings the two that there are") {
  CHECK_THAT(message_of<InputError>([] { read("layout: stakced"); }),
             Contains("model.yaml:") && Contains("layout") && Contains("did you mean 'stacked'?"));
  CHECK_THAT(message_of<InputError>([] { read("layuot: stacked"); }), Contains("did you mean 'layout'?"));
}

TEST_CASE("where there would be too many datasets they are stacked, unless the names are asked for") {
  const test::TemporaryFolder folder;
  const auto layout_of = [&](int nodes, std::optional<ResultsLayout> wanted) {
    Model model;
    for (int k = 0; k < nodes; ++k) {
      Node node;
      node.name = fmt::format("n{}", k);
      model.add_node(node);
    }
    ResultsFile(folder / "run.h5", model, "", wanted).complete();
    return Hdf5File::open(folder / "run.h5").read_text_attribute("/", "layout");
  };
  CHECK(layout_of(100, {}) == "named");
  CHECK(layout_of(10'000, {}) == "stacked");
  CHECK(layout_of(100, ResultsLayout::stacked) == "stacked");
  CHECK(layout_of(10'000, ResultsLayout::named) == "named");
}

}  // namespace test_results_layout
