#include "mechanism/analyses/state_space_analysis.hpp"

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/response_reader.hpp"
#include "mechanism/analyses/rotation_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

void write_matrix(Session& session, const char* name, const MatrixX& matrix, const char* description) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) values.push_back(matrix(i, j));
  session.write({fmt::format("state_space/{}", name),
                 {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())},
                 std::move(values),
                 "-",
                 description});
}

}  // namespace

const KeyTable& state_space_keys() {
  using namespace keys;
  static const KeyTable table{"the analysis 'state_space'",
                              "Small motions as matrices: E x' = A x + B u, y = C x + D u.",
                              joined({{analysis_type_key("state_space")}, response_keys(), {rotation_key()}})};
  return table;
}

std::unique_ptr<Analysis> read_state_space_analysis(const YamlValue& entry, const Model& model) {
  StateSpaceOptions options;
  options.inputs = read_response_inputs(entry, model);
  options.outputs = read_response_outputs(entry, model);
  if (const auto rotation = entry.find("rotation")) options.rotation = read_rotation(*rotation, model);
  return std::make_unique<StateSpaceAnalysis>(std::move(options));
}

void StateSpaceAnalysis::solve(Session& session, AnalysisSummary& summary) const {
  const StateSpace found = compute_state_space(session, options_);
  if (found.E.rows() == 0) {
    summary.text = "state_space: nothing can move\n";
    summary.numbers["states"].push_back(0);
    return;
  }
  write_matrix(session, "E", found.E, "regular, of E x' = A x + B u");
  write_matrix(session, "A", found.A, "of E x' = A x + B u");
  write_matrix(session, "B", found.B, "columns as `inputs`, which are deviations from their values in the state");
  write_matrix(session, "C", found.C, "rows as `outputs`, deviations likewise, of y = C x + D u");
  write_matrix(session, "D", found.D, "of y = C x + D u");
  write_matrix(session, "shapes", found.unknowns, "increments of `unknowns`, each in its units, of each state");
  std::vector<std::string> inputs, outputs, unknowns;
  for (const ResponseInput& input : options_.inputs) inputs.push_back(input.name);
  for (std::size_t k = 0; k < options_.outputs.size(); ++k)
    outputs.push_back(fmt::format("{} [{}]", options_.outputs[k].name, found.output_units[k]));
  for (int i = 0; i < found.unknowns.rows(); ++i) unknowns.push_back(session.system().unknown_name(i));
  session.write(ResultNames{"state_space/inputs", inputs});
  session.write(ResultNames{"state_space/outputs", outputs});
  session.write(ResultNames{"state_space/unknowns", unknowns});
  summary.numbers["states"].push_back(static_cast<double>(found.E.rows()));
  summary.text = fmt::format("state_space, {} from {} to {}\n", counted(found.E.rows(), "state"),
                             counted(inputs.size(), "input"), counted(outputs.size(), "output"));
  summary.text += format_setting(found, "its matrices");
}

}  // namespace bielle::mechanism
