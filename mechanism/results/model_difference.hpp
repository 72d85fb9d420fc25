// Finds the values of a model that have changed since a checkpoint was written, by the digest of the input.
#pragma once

#include <string>

namespace bielle::mechanism {

class Model;

/// Returns Model::source in the format of a results file: one line for each value, with its path and its digest.
std::string source_lines(const Model& model);

/// Both texts are empty if nothing differs.
struct ModelDifference {
  std::string entry;   ///< the first different entry: "joint 'main'"
  std::string values;  ///< the first differences: "joints.main.stops.damping was 3 and is 4; loads.wind is new"
};

/// @param before  the lines of `source_lines` of a checkpoint
ModelDifference difference_from(const std::string& before, const Model& model);

}  // namespace bielle::mechanism
