#include "mechanism/analyses/analysis_table.hpp"

namespace bielle::mechanism {

// Each reader is defined in the file of its analysis.
AnalysisReader read_assembly, read_static, read_dynamic, read_kinematic, read_inverse_dynamics, read_eigen,
    read_campbell, read_frequency_response, read_state_space_analysis;

const std::vector<AnalysisType>& analysis_table() {
  static const std::vector<AnalysisType> table = {
      {"assembly", read_assembly, nullptr},
      {"static", read_static, nullptr},
      {"dynamic", read_dynamic, nullptr},
      {"kinematic", read_kinematic, nullptr},
      {"inverse_dynamics", read_inverse_dynamics, nullptr},
      {"eigen", read_eigen, nullptr},
      {"campbell", read_campbell, nullptr},
      {"frequency_response", read_frequency_response, nullptr},
      {"state_space", read_state_space_analysis, nullptr},
  };
  return table;
}

std::unique_ptr<Analysis> read_analysis(const YamlValue& entry, const Model& model) {
  const YamlValue type = entry.at("type");
  std::vector<std::string> names;
  for (const AnalysisType& known : analysis_table()) {
    if (type.text() == known.name) return known.read(known.keys ? entry.keyed(known.keys()) : entry, model);
    names.emplace_back(known.name);
  }
  type.word(names, "a type of analysis");
  return nullptr;  // not reached: the word is checked above
}

}  // namespace bielle::mechanism
