// The entries of a matrix where those of its factor will be.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "reduce/spectral/bordered_part.hpp"
#include "reduce/spectral/supernodal_solver.hpp"

namespace bielle {

/// The position of a row in a supernode; entries come in runs of rows that follow each other.
class RowFinder {
 public:
  explicit RowFinder(const SupernodalFactor& structure) : structure_(structure) {}
  std::int64_t find(std::int64_t s, std::int64_t row);
  /// Whether a row was asked for that its supernode has not.
  bool is_outside() const { return is_outside_; }

 private:
  const SupernodalFactor& structure_;
  std::int64_t last_ = -1, at_ = 0;
  bool is_outside_ = false;
};

/// The row of L of each unknown.
std::vector<std::int64_t> places_in_order(const SupernodalFactor& structure);

/// The entries of A where those of L will be.
class SpreadEntries {
 public:
  /// @param values  of L, zero
  SpreadEntries(const SupernodalFactor& structure, double* values);
  /// @param threads  share the entries
  void spread(const BorderedPart& a, int threads) const;

 private:
  void set(RowFinder& finder, std::int64_t place, std::int64_t other, double value) const {
    const auto column = static_cast<std::size_t>(std::min(place, other));
    above_[column][finder.find(owner_[column], std::max(place, other))] = value;
  }

  const SupernodalFactor& structure_;
  std::vector<std::int32_t> owner_;  // supernode of each column
  std::vector<double*> above_;       // the first number of each column
};

}  // namespace bielle
