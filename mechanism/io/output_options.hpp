// The section `output` of a mechanism file: which rows of results are recorded, and what is in them.
#pragma once

#include "mechanism/session/recording.hpp"
#include "mechanism/system/model.hpp"

namespace bielle::mechanism {

struct OutputOptions {
  Recording recording;
  bool log = false;  ///< a table of all attempted steps next to the results
};

/// Reads the section, and tells the model's components and groups what to record.
/// @param end  of the last dynamic analysis [s]
/// @throws InputError
OutputOptions read_output(const YamlValue& entry, double end, Model& model);

}  // namespace bielle::mechanism
