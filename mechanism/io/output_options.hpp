// The section `output` of a mechanism file: which rows of results are recorded, and what is in them.
#pragma once

#include <vector>

#include "mechanism/system/model.hpp"

namespace bielle::mechanism {

struct OutputOptions {
  int every = 1;  ///< steps between records; the first and the last are always recorded
  /// [s], ascending: if any, dynamic analyses record their start and these times in place of steps.
  std::vector<double> times;
  bool log = false;    ///< a table of all attempted steps beside the results
  int checkpoint = 0;  ///< steps between points that a run can go on from; 0: at the end of dynamic analyses only
};

/// Reads the section, and tells the model's components and groups what to record.
/// @param end  of the last dynamic analysis [s]
/// @throws InputError
OutputOptions read_output(const YamlValue& entry, double end, Model& model);

}  // namespace bielle::mechanism
