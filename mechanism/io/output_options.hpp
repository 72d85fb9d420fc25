// The section `output` of a mechanism file: the rows of results to record, and their contents.
#pragma once

#include <optional>

#include "mechanism/model/model.hpp"
#include "mechanism/results/recording.hpp"
#include "mechanism/results/results_rows.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct OutputOptions {
  Recording recording;
  std::optional<ResultsLayout> layout;  ///< empty: chosen by the size of the model
  bool log = false;                     ///< a table of all attempted steps next to the results
};

const KeyTable& output_keys();
/// Reads the section and sets the outputs of the model's components.
/// @param end  end of the last dynamic analysis [s] @throws InputError
OutputOptions read_output(const YamlValue& entry, double end, bool statics, Model& model);

}  // namespace bielle::mechanism
