#include "mechanism/math/sparse_pattern.hpp"

#include <algorithm>

#include "mechanism/math/fill_orderings.hpp"

namespace bielle::mechanism {

SparsePattern::SparsePattern(std::vector<int> column_start, std::vector<int> row)
    : size_(static_cast<int>(column_start.size()) - 1),
      column_start_(std::move(column_start)),
      row_(std::move(row)),
      orderings_(std::make_shared<const FillOrderings>()) {}

SparsePattern::SparsePattern(int size, std::vector<std::pair<int, int>> entries)
    : size_(size), orderings_(std::make_shared<const FillOrderings>()) {
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second < b.second : a.first < b.first;
  });
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  column_start_.assign(static_cast<std::size_t>(size) + 1, 0);
  row_.reserve(entries.size());
  for (const auto& [row, column] : entries) {
    ++column_start_[static_cast<std::size_t>(column) + 1];
    row_.push_back(row);
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(size); ++c) column_start_[c + 1] += column_start_[c];
}

int SparsePattern::find(int row, int column) const {
  const auto begin = row_.begin() + column_start_[static_cast<std::size_t>(column)];
  const auto end = row_.begin() + column_start_[static_cast<std::size_t>(column) + 1];
  const auto place = std::lower_bound(begin, end, row);
  return place != end && *place == row ? static_cast<int>(place - row_.begin()) : -1;
}

}  // namespace bielle::mechanism
