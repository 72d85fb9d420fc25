// Builds the pattern of a sparse matrix from its entries, by counting: time and memory grow with their number.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "mechanism/math/sparse_pattern.hpp"

namespace bielle::mechanism {

/// @param for_each_entry  calls its argument with row and column of each entry, in any order, possibly repeated. It is
///                        called twice, and must give the same entries both times
template <class ForEachEntry>
SparsePattern gather_columns(int size, const ForEachEntry& for_each_entry) {
  std::vector<int> start(static_cast<std::size_t>(size) + 1, 0);
  for_each_entry([&](int /*row*/, int column) { ++start[static_cast<std::size_t>(column) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<int> rows(static_cast<std::size_t>(start.back())), next(start.begin(), start.end() - 1);
  for_each_entry(
      [&](int row, int column) { rows[static_cast<std::size_t>(next[static_cast<std::size_t>(column)]++)] = row; });
  next = {};
  // Each column is sorted and its duplicates are removed; the columns are moved together.
  auto end = rows.begin();
  for (std::size_t column = 0; column < static_cast<std::size_t>(size); ++column) {
    const auto first = rows.begin() + start[column], last = rows.begin() + start[column + 1];
    start[column] = static_cast<int>(end - rows.begin());
    std::sort(first, last);
    int previous = -1;
    for (auto each = first; each != last; ++each)
      if (*each != previous) *end++ = previous = *each;
  }
  start.back() = static_cast<int>(end - rows.begin());
  rows.erase(end, rows.end());
  rows.shrink_to_fit();
  return SparsePattern(std::move(start), std::move(rows));
}

}  // namespace bielle::mechanism
