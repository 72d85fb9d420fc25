// This comparison finds the values of a model that have changed since a checkpoint was written, one by one, by the
// digest of the input.
#pragma once

#include <string>

namespace bielle::mechanism {

class Model;

/// Model::source as it is kept in a results file: a line for each value, its path and its digest.
std::string source_lines(const Model& model);

/// Both are empty where nothing differs.
struct ModelDifference {
  std::string entry;   ///< the first that differs: "joint 'main'"
  std::string values;  ///< the first few: "joints.main.stops.damping was 3 and is 4; loads.wind is new"
};

/// @param before  lines of `source_lines`, of a checkpoint
ModelDifference difference_from(const std::string& before, const Model& model);

}  // namespace bielle::mechanism
