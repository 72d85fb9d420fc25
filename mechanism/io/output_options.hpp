// The section `output` of a mechanism file: which rows of results are recorded, and what is in them.
#pragma once

#include <optional>

#include "mechanism/model/model.hpp"
#include "mechanism/results/recording.hpp"
#include "mechanism/results/results_rows.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct OutputOptions {
  Recording recording;
  std::optional<ResultsLayout> layout;  ///< nothing: what suits the size of the model
  bool log = false;                     ///< a table of all attempted steps next to the results
};

/// Reads the section and sets what the model's components record.
/// @param end  of the last dynamic analysis [s]
/// @throws InputError
OutputOptions read_output(const YamlValue& entry, double end, bool statics, Model& model);

}  // namespace bielle::mechanism
