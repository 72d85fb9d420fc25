// The cost of results of large models: setting up their rows, making the datasets, writing, closing.
//
//   performance_mechanism_results named|stacked LINKS [ROWS]      ROWS: 20
//
// Each link has a node, a rigid body and a hinge, replaced by components that record as many numbers and compute
// nothing. All times are processor times of both threads; for a row, the times for its numbers and for copying them in
// memory are given separately, within the same run. A run has one size, so that its peak of memory belongs to this
// size.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

#include "mechanism/model/model.hpp"
#include "mechanism/results/results_file.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/performance/processor_time.hpp"

namespace {

using namespace bielle::mechanism;

class Recorder : public Component {
 public:
  Recorder(const std::string& type, const std::string& name, std::vector<OutputField> fields,
           std::vector<std::pair<std::string, std::string>> facts)
      : Component(type, name), fields_(std::move(fields)), facts_(std::move(facts)) {}
  void declare(Declaration&) const override {}
  void add_residual(const LocalState&, Eigen::Ref<VectorX>) const override {}
  void add_tangent(const LocalState&, LocalTangent&) const override {}
  std::vector<OutputField> output_fields() const override { return fields_; }
  void write_output(const LocalState& state, double* values) const override {
    for (const OutputField& field : fields_)
      for (std::size_t k = 0; k < field.size(); ++k) *values++ = state.time();
  }
  std::vector<std::pair<std::string, std::string>> attributes() const override { return facts_; }

 private:
  std::vector<OutputField> fields_;
  std::vector<std::pair<std::string, std::string>> facts_;
};

Model chain(int links) {
  Model model;
  for (int k = 0; k < links; ++k) {
    const std::string node = fmt::format("n{}", k), before = k == 0 ? "ground" : fmt::format("n{}", k - 1);
    Node made;
    made.name = node;
    model.add_node(std::move(made));
    model.add(
        std::make_unique<Recorder>(
            "rigid_body", fmt::format("e{}", k),
            std::vector<OutputField>{
                {"centre", {3}, "m", ""}, {"momentum", {3}, "kg m/s", ""}, {"angular_momentum", {3}, "N m s", ""}},
            std::vector<std::pair<std::string, std::string>>{
                {"node", node}, {"mass", "1"}, {"centre", "0 0 0"}, {"inertia", "1 1 1 0 0 0"}}),
        Entry{Section::elements, fmt::format("e{}", k)});
    model.add(std::make_unique<Recorder>(
                  "hinge", fmt::format("j{}", k),
                  std::vector<OutputField>{{"coordinate", {1}, "rad", "angle"},
                                           {"rate", {1}, "rad/s", "angle"},
                                           {"reaction", {6}, "N, N m", ""},
                                           {"reaction_inertial", {6}, "N, N m", ""}},
                  std::vector<std::pair<std::string, std::string>>{{"first_node", before}, {"second_node", node}}),
              Entry{Section::joints, fmt::format("j{}", k)});
  }
  return model;
}

double processor() { return bielle::performance::processor_seconds(CLOCK_PROCESS_CPUTIME_ID); }

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void measure(ResultsLayout layout, int links, int rows) {
  const std::string path = (std::filesystem::temp_directory_path() / "bielle_performance_results.h5").string();
  const Model model = chain(links);
  State state;
  state.nodes.resize(model.nodes().size());
  for (NodeState& node : state.nodes) node.R.setIdentity();
  const std::vector<Slots> slots(model.members().size());
  const double model_peak = peak_megabytes();
  double at = processor();
  const auto took = [&at] { return processor() - std::exchange(at, processor()); };
  const std::size_t row = ResultsRows(model).size();
  const double rows_only = took();
  ResultsFile results(path, model, "", layout);
  took();
  results.begin_analysis("dynamic", static_cast<std::size_t>(rows) + 1);
  results.record(state, slots, model.environment, {});
  results.file();  // waits until the row is written
  const double first = took();
  for (int k = 0; k < rows; ++k) {
    state.time = k;
    results.record(state, slots, model.environment, {});
  }
  results.file();
  const double writing = took();
  results.end_analysis();
  results.complete();
  const double closing = took();
  const double peak = peak_megabytes();
  ResultsRows rows_alone(model);
  std::vector<double> values(row), copied(row);
  took();
  for (int k = 0; k < rows; ++k) rows_alone.fill(state, slots, model.environment, {}, values.data());
  const double filling = took();
  for (int k = 0; k < rows; ++k) {
    values[static_cast<std::size_t>(k) % row] = k;
    std::memcpy(copied.data(), values.data(), row * sizeof(double));
    if (copied[static_cast<std::size_t>(k) % row] != k) std::abort();
  }
  const double copying = took();
  const double megabytes = static_cast<double>(row * sizeof(double)) / 1e6;
  fmt::print(
      "{:<8} {:>7} links, row of {:.1f} MB: rows set up in {:.3f} s, datasets and first row {:.3f} s, each further "
      "row {:.5f} s, of which its numbers {:.5f} s (copied in memory: {:.5f} s); closing {:.3f} s; peak {:.0f} MB, "
      "of which the model {:.0f}; file {:.0f} MB\n",
      layout_name(layout), links, megabytes, rows_only, first, writing / rows, filling / rows, copying / rows, closing,
      peak, model_peak, static_cast<double>(std::filesystem::file_size(path)) / 1e6);
  std::filesystem::remove(path);
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    fmt::print(stderr, "performance_mechanism_results named|stacked LINKS [ROWS]\n");
    return 1;
  }
  const bool named = std::string(words[1]) == "named";
  measure(named ? ResultsLayout::named : ResultsLayout::stacked, std::atoi(words[2]),
          count > 3 ? std::atoi(words[3]) : 20);
}
