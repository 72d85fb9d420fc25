// A result that is not a row over time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bielle::mechanism {

/// Examples: frequencies, modes, matrices, peaks.
struct ResultArray {
  std::string dataset;             ///< relative to the analysis's group: "eigen/frequency"
  std::vector<std::size_t> shape;  ///< {} for a number
  std::vector<double> values;      ///< the last index runs fastest
  std::string units, description;
};

/// Names of the entries of an array.
struct ResultNames {
  std::string dataset;  ///< relative to the analysis's group
  std::vector<std::string> names;
};

}  // namespace bielle::mechanism
