#include "mechanism/analyses/analysis_table.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bielle::mechanism {

// Each stands in the file of its analysis.
AnalysisReader read_assembly, read_static, read_dynamic, read_kinematic, read_inverse_dynamics;

const std::vector<AnalysisType>& analysis_table() {
  static const std::vector<AnalysisType> table = {
      {"assembly", read_assembly},
      {"static", read_static},
      {"dynamic", read_dynamic},
      {"kinematic", read_kinematic},
      {"inverse_dynamics", read_inverse_dynamics},
  };
  return table;
}

namespace {

const std::vector<std::string> planned = {"eigen", "frequency_response", "state_space"};

/// "a, b and c"
std::string listed(const std::vector<std::string>& names) {
  std::string text = names.front();
  for (std::size_t k = 1; k < names.size(); ++k) text += (k + 1 < names.size() ? ", " : " and ") + names[k];
  return text;
}

}  // namespace

std::unique_ptr<Analysis> read_analysis(const YamlValue& entry, const Model& model) {
  const YamlValue type = entry.at("type");
  std::vector<std::string> names;
  for (const AnalysisType& known : analysis_table()) {
    if (type.text() == known.name) return known.read(entry, model);
    names.emplace_back(known.name);
  }
  if (std::find(planned.begin(), planned.end(), type.text()) != planned.end())
    type.fail(fmt::format("the analysis '{}' is not in this version; there are {}", type.text(), listed(names)));
  type.word(names, "a type of analysis");
  return nullptr;  // never: no such word
}

}  // namespace bielle::mechanism
