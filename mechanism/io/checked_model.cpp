#include "mechanism/io/checked_model.hpp"

#include "mechanism/io/run_analyses.hpp"
#include "mechanism/results/results_file.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/redundancy_at_start.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/files/file_checks.hpp"
#include "reduce/common/files/hdf5_file.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the entries of joints whose constraints are set aside, each once: "joints/main".
std::vector<std::string> entries_set_aside(const CheckedModel& checked) {
  std::vector<std::string> entries;
  const std::vector<Slots>& slots = checked.system.slots();
  std::size_t member = 0;
  for (const int multiplier : checked.redundant) {  // both these and the slots of the members are in ascending order
    while (multiplier >= slots[member].multiplier_begin + slots[member].multipliers) ++member;
    const std::string entry = results_path(checked.file.model.members()[member].entry);
    if (entries.empty() || entries.back() != entry) entries.push_back(entry);
  }
  return entries;
}

std::string sentence_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

CheckedModel::CheckedModel(const MechanismFile& of) : file(of), system(of.model), state(system.start(0)) {
  const State drawn = state;
  const Environment& environment = file.model.environment;
  const AssemblyOptions kept = file.analyses.empty() ? AssemblyOptions() : file.analyses.front()->kept();
  try {
    State assembled;
    redundant = take_out_redundant_at_start(system, environment, state, assembled);
    assemble_positions(system, environment, state, report,
                       with_kept(system, environment, state, conditions_of_file(system), kept));
  } catch (const ComputationError&) {
    failure = std::current_exception();
    state = drawn;
  }
}

void write_checked_model(const CheckedModel& checked, const std::string& results_path) {
  check_output_file(results_path);
  check_may_be_replaced(results_path);
  const Model& model = checked.file.model;
  ResultsFile results(results_path, model, checked.file.text, checked.file.output.layout);
  results.name_equations(checked.system);
  if (const std::vector<std::string> entries = entries_set_aside(checked); !entries.empty())
    results.file().write_names("/redundant", entries);
  results.begin_analysis("check", 1);
  results.file().write_attribute(results.analysis_group(), "assembled", std::int64_t{checked.failure ? 0 : 1});
  if (checked.failure)
    results.file().write_attribute(results.analysis_group(), "failure", sentence_of(checked.failure));
  results.record(checked.state, checked.system.slots(), model.environment, {});
  results.end_analysis();
  results.complete();
}

}  // namespace bielle::mechanism
