// A result that is no row over time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bielle::mechanism {

/// Frequencies, modes, matrices, peaks.
struct ResultArray {
  std::string dataset;             ///< relative to the analysis's group: "eigen/frequency"
  std::vector<std::size_t> shape;  ///< {} for a number
  std::vector<double> values;      ///< the last index runs fastest
  std::string units, description;
};

/// Names that go with them.
struct ResultNames {
  std::string dataset;  ///< as above
  std::vector<std::string> names;
};

}  // namespace bielle::mechanism
