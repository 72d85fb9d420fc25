// The supernodes of a matrix to which a few dense rows and columns are appended: they are eliminated at last.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/spectral/supernodal_solver.hpp"

namespace bielle {

/// Every supernode gets the new rows at its end, and one more supernode holds them.
class BorderedStructure {
 public:
  /// @param inner   outlives this
  /// @param border  rows that are appended; 0: the structure stays as it is
  BorderedStructure(const SupernodalFactor& inner, std::int64_t border);
  BorderedStructure(const BorderedStructure&) = delete;
  BorderedStructure& operator=(const BorderedStructure&) = delete;

  const SupernodalFactor& structure() const { return structure_; }

 private:
  std::vector<std::int64_t> columns_, row_starts_, value_starts_, rows_, order_;
  SupernodalFactor structure_;
};

}  // namespace bielle
