// Table of all types of analysis by name: the only place where a new one is registered.
#pragma once

#include <memory>
#include <vector>

#include "mechanism/analyses/analysis.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Reads the keys of an entry of the section `analysis`. @throws InputError
using AnalysisReader = std::unique_ptr<Analysis>(const YamlValue& entry, const Model& model);

struct AnalysisType {
  const char* name;  ///< value of the entry's `type`
  AnalysisReader* read;
  const KeyTable& (*keys)();  ///< keys that an entry may contain
};

/// Returns the key that names the type of an analysis.
Key analysis_type_key(const std::string& type);

const std::vector<AnalysisType>& analysis_table();

/// Reads an entry of the section `analysis`. @throws InputError for an unknown type, naming the nearest name
std::unique_ptr<Analysis> read_analysis(const YamlValue& entry, const Model& model);

}  // namespace bielle::mechanism
