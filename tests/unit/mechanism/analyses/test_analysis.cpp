// A user-defined analysis runs like those of the table, into every sink.
#include <catch2/catch.hpp>

#include "mechanism/analyses/dynamic_analysis.hpp"
#include "mechanism/analyses/static_analysis.hpp"
#include "mechanism/io/describe_model.hpp"
#include "mechanism/io/run_analyses.hpp"
#include "mechanism/results/memory_sink.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using Catch::Contains;

namespace {

/// The masses of the unknowns, and one row of the assembled state.
class MassAnalysis : public Analysis {
 public:
  MassAnalysis() : Analysis("masses") {}
  std::size_t expected_rows(const Recording&) const override { return 1; }

 private:
  void solve(Session& session, AnalysisSummary& summary) const override {
    session.assemble();
    const System& system = session.system();
    std::vector<double> values;
    system.tangent(session.state(), session.environment(), {0, 0, 1, 0, 0}, nullptr, values);
    ResultArray masses{"masses/diagonal", {static_cast<std::size_t>(system.dofs())}, {}, "kg, kg m^2", "by unknowns"};
    for (int i = 0; i < system.dofs(); ++i)
      masses.values.push_back(values[static_cast<std::size_t>(system.pattern().find(i, i))]);
    session.write(masses);
    summary.records = session.rows();
    summary.numbers["diagonal"] = masses.values;
    summary.text = "masses\n";
  }
};

MechanismFile block(const std::string& more = "") {
  return read_mechanism_text(R"yaml(
mechanism: a block
gravity: [0, 0, -10]
nodes: {block: {position: [0, 0, 0]}}
elements: {block: {type: rigid_body, node: block, mass: 3, inertia: [1, 2, 2.5]}}
)yaml" + more,
                             "block.yaml");
}

const std::vector<double> block_masses = {3, 3, 3, 1, 2, 2.5};

}  // namespace

TEST_CASE("an analysis of one's own records rows and arrays in memory") {
  Session session(block().model);
  MemorySink memory(session.model());
  session.add_sink(memory);
  const AnalysisSummary summary = MassAnalysis().run(session);
  CHECK(summary.records == 1);
  CHECK(summary.numbers.at("diagonal") == block_masses);
  REQUIRE(memory.analyses().size() == 1);
  CHECK(memory.analyses().front().type == "masses");
  CHECK(memory.read(0, "masses/diagonal") == block_masses);
  CHECK(memory.read(0, "nodes/block/position") == std::vector<double>{0, 0, 0});
}

TEST_CASE("an analysis of one's own runs with those of a file, into its results and its summary") {
  const test::TemporaryFolder folder;
  const std::string path = folder / "block.h5";
  MechanismFile file = block("analysis: [{type: dynamic, duration: 0.1, step: 0.01}]");
  file.analyses.push_back(std::make_unique<MassAnalysis>());
  Progress progress(true);
  const std::vector<AnalysisSummary> summaries = run_analyses(file, path, progress);
  const Hdf5File results = Hdf5File::open(path);
  CHECK(results.read_text_attribute("/analysis_2", "type") == "masses");
  CHECK(results.read("/analysis_2/masses/diagonal") == block_masses);
  CHECK(results.units("/analysis_2/masses/diagonal") == "kg, kg m^2");
  CHECK(results.read("/analysis_2/time") == std::vector<double>{0.1});
  CHECK(results.read_integer_attribute("/", "complete") == 1);
  CHECK_THAT(format_summary(file, summaries, {}, path), Contains("a block\ndynamic, generalised-alpha, rho = 0.8\n") &&
                                                            Contains("10 steps") && Contains("\nmasses\nresults: "));
}

TEST_CASE("an analysis made in C++ does what the same one of a file does") {
  DynamicsOptions options;
  options.duration = 0.1;
  options.stepping.size = 0.01;
  const DynamicAnalysis made(options, "generalised-alpha, rho = 0.8");
  const MechanismFile file = block("analysis: [{type: dynamic, duration: 0.1, step: 0.01}]");
  Session one(file.model), two(file.model);
  const AnalysisSummary a = made.run(one), b = file.analyses.front()->run(two);
  CHECK(a.text == b.text);
  CHECK(a.numbers == b.numbers);
  CHECK(a.records == 11);
  CHECK(one.save() == two.save());
  CHECK(made.expected_rows({}) == 12);
  CHECK(made.expected_rows({5, {}, 0}) == 4);
  CHECK(made.expected_rows({1, {0.02, 0.03}, 0}) == 3);
}

TEST_CASE("an analysis that cannot go on says so") {
  Session session(block().model);
  MemorySink memory(session.model());
  CHECK_THROWS_AS(MassAnalysis().go_on(session, {}, memory), std::logic_error);
  CHECK_FALSE(MassAnalysis().can_go_on());
}
