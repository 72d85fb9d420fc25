// All sinks get the same numbers, and their presence does not change the numbers.
#include "swinging_arms.hpp"
#include <catch2/catch.hpp>

#include "mechanism/analyses/dynamic_analysis.hpp"
#include "mechanism/io/run_analyses.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::all_numbers;
using bielle::test::swing;
using bielle::test::swinging_arms;

TEST_CASE("rows in memory are those of the results file of the same run, to the last bit") {
  for (const auto& [step, tolerance, output] :
       {std::tuple("step: 1e-3", 0.0, "every: 3, checkpoint: 30"), std::tuple("step: 1e-3, tolerance: 1e-6", 1e-6, ""),
        std::tuple("step: 1e-3", 0.0, "times: [0.05, 0.12345, 0.3]")}) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "arms.h5";
    const MechanismFile file = swinging_arms("output: {" + std::string(output) +
                                             "}\nanalysis: [{type: dynamic, duration: 0.4, " + step + "}]\n");
    Progress progress(true);
    run_analyses(file, path, progress);

    Session session(file.model);
    MemorySink memory(session.model());
    session.add_sink(memory);
    session.set_recording(file.output.recording);
    session.begin_analysis("dynamic");
    {
      Motion motion = session.dynamics(swing(0.4, tolerance));
      while (motion.step()) {
      }
    }
    session.end_analysis();

    const Hdf5File results = Hdf5File::open(path);
    CHECK(memory.read(0, "time") == results.read("/analysis_1/time"));
    for (const ResultsColumn& column : memory.columns()) {
      INFO(column.dataset);
      CHECK(memory.read(0, column.dataset) == results.read("/analysis_1/" + column.dataset));
    }
    CHECK_THROWS_AS(memory.read(0, "nodes/nobody/position"), InputError);
  }
}

TEST_CASE("what is read between the steps is what is recorded") {
  Session session(swinging_arms().model);
  MemorySink memory(session.model());
  session.add_sink(memory);
  std::vector<double> angle, input;
  session.on_step([&](Session& at) {
    angle.push_back(at.read("joints/elbow/coordinate")[0]);
    input.push_back(at.read("energy/input")[0]);
  });
  session.begin_analysis("swing");
  Motion motion = session.dynamics(swing(0.1));
  motion.finish();
  session.end_analysis();
  const std::vector<double> rows = memory.read(0, "joints/elbow/coordinate");
  REQUIRE(rows.size() == 101);
  CHECK(std::vector<double>(rows.begin() + 1, rows.end()) == angle);
  const std::vector<double> inputs = memory.read(0, "energy/input");
  CHECK(std::vector<double>(inputs.begin() + 1, inputs.end()) == input);
}

TEST_CASE("who listens does not change the motion, and a stop is its last row") {
  const auto run = [](Session& session) {
    session.set_recording({7, {}, 20});
    session.on_step([](Session& at) {
      if (at.time() > 0.0995) at.stop();
    });
    Motion motion = session.dynamics(swing(0.2));
    CHECK_FALSE(motion.finish());
    return all_numbers(session);
  };
  Session alone(swinging_arms().model), heard(swinging_arms().model);
  MemorySink one(heard.model()), two(heard.model());
  heard.add_sink(one);
  heard.add_sink(two);
  heard.begin_analysis("swing");
  CHECK(run(alone) == run(heard));
  heard.end_analysis();
  CHECK(one.read(0, "time").size() == 1 + 100 / 7 + 1);
  CHECK(one.read(0, "time").back() == heard.time());
  CHECK(one.analyses().front().values == two.analyses().front().values);
}

TEST_CASE("without an open analysis nothing is recorded") {
  Session session(swinging_arms().model);
  MemorySink memory(session.model());
  session.add_sink(memory);
  session.assemble();
  CHECK(memory.analyses().empty());
  CHECK_THROWS_AS(session.write({"a", {}, {1}, "-", ""}), std::logic_error);
  CHECK_THROWS_AS(session.set_recording({0, {}, 0}), InputError);
}
