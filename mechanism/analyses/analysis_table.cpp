#include "mechanism/analyses/analysis_table.hpp"

namespace bielle::mechanism {

using AnalysisKeys = const KeyTable&();

// Each reader and its table of keys are defined in the file of the analysis.
AnalysisReader read_assembly, read_static, read_dynamic, read_kinematic, read_inverse_dynamics, read_eigen,
    read_campbell, read_frequency_response, read_state_space_analysis;
AnalysisKeys assembly_keys, static_keys, dynamic_keys, kinematic_keys, inverse_dynamics_keys, eigen_keys, campbell_keys,
    frequency_response_keys, state_space_keys;

Key analysis_type_key(const std::string& type) {
  return {"type", keys::word({type}, "a type of analysis"), keys::required, "The type of the analysis."};
}

const std::vector<AnalysisType>& analysis_table() {
  static const std::vector<AnalysisType> table = {
      {"assembly", read_assembly, assembly_keys},
      {"static", read_static, static_keys},
      {"dynamic", read_dynamic, dynamic_keys},
      {"kinematic", read_kinematic, kinematic_keys},
      {"inverse_dynamics", read_inverse_dynamics, inverse_dynamics_keys},
      {"eigen", read_eigen, eigen_keys},
      {"campbell", read_campbell, campbell_keys},
      {"frequency_response", read_frequency_response, frequency_response_keys},
      {"state_space", read_state_space_analysis, state_space_keys},
  };
  return table;
}

std::unique_ptr<Analysis> read_analysis(const YamlValue& entry, const Model& model) {
  const YamlValue type = entry.at("type");
  std::vector<std::string> names;
  for (const AnalysisType& known : analysis_table()) {
    if (type.text() == known.name) return known.read(entry.keyed(known.keys()), model);
    names.emplace_back(known.name);
  }
  type.word(names, "a type of analysis");
  return nullptr;  // not reached: the word is checked above
}

}  // namespace bielle::mechanism
