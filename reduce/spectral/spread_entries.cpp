#include "reduce/spectral/spread_entries.hpp"

#include <algorithm>

namespace bielle {

std::int64_t RowFinder::find(std::int64_t s, std::int64_t row) {
  if (s == last_) {
    const std::int64_t* const rows = structure_.rows + structure_.row_starts[s];
    if (rows[at_] == row) return at_;
    if (at_ + 1 < structure_.row_starts[s + 1] - structure_.row_starts[s] && rows[at_ + 1] == row) return ++at_;
  }
  last_ = s;
  const std::int64_t first = structure_.columns[s], width = structure_.columns[s + 1] - first;
  if (row < first + width) return at_ = row - first;
  const std::int64_t* const begin = structure_.rows + structure_.row_starts[s];
  const std::int64_t* const end = structure_.rows + structure_.row_starts[s + 1];
  const std::int64_t* const place = std::lower_bound(begin + width, end, row);
  is_outside_ = is_outside_ || place == end || *place != row;
  return at_ = std::min(place, end - 1) - begin;
}

std::vector<std::int64_t> places_in_order(const SupernodalFactor& structure) {
  std::vector<std::int64_t> places(static_cast<std::size_t>(structure.size));
  for (std::int64_t k = 0; k < structure.size; ++k) places[static_cast<std::size_t>(structure.order[k])] = k;
  return places;
}

SpreadEntries::SpreadEntries(const SupernodalFactor& structure, double* values)
    : structure_(structure),
      owner_(static_cast<std::size_t>(structure.size)),
      above_(static_cast<std::size_t>(structure.size)) {
  for (std::int64_t s = 0; s < structure.supernodes; ++s) {
    const std::int64_t rows = structure.row_starts[s + 1] - structure.row_starts[s];
    for (std::int64_t column = structure.columns[s]; column < structure.columns[s + 1]; ++column) {
      owner_[static_cast<std::size_t>(column)] = static_cast<std::int32_t>(s);
      above_[static_cast<std::size_t>(column)] =
          values + structure.value_starts[s] + (column - structure.columns[s]) * rows;
    }
  }
}

void SpreadEntries::spread(const BorderedPart& a, int threads) const {
  const std::vector<std::int64_t> places = places_in_order(structure_);
  std::vector<std::int64_t> places_of_whole(static_cast<std::size_t>(a.whole.size), -1);
  for (std::size_t k = 0; k < a.kept.size(); ++k) places_of_whole[static_cast<std::size_t>(a.kept[k])] = places[k];
#pragma omp parallel num_threads(threads)
  {
    RowFinder finder(structure_);
#pragma omp for schedule(dynamic, 1024)
    for (std::size_t k = 0; k < a.kept.size(); ++k) {
      const auto j = static_cast<std::size_t>(a.kept[k]);
      for (std::int64_t p = a.whole.starts[j]; p < a.whole.starts[j + 1]; ++p) {
        const std::int64_t other = places_of_whole[static_cast<std::size_t>(a.whole.rows[p])];
        if (other >= 0) set(finder, places[k], other, a.whole.values[p]);
      }
    }
  }
  RowFinder finder(structure_);
  const auto kept = static_cast<Eigen::Index>(a.kept.size());
  for (Eigen::Index c = 0; c < a.corner.cols(); ++c) {
    const std::int64_t place = places[static_cast<std::size_t>(kept + c)];
    for (Eigen::Index k = 0; k < kept; ++k)
      if (a.border(k, c) != 0) set(finder, places[static_cast<std::size_t>(k)], place, a.border(k, c));
    for (Eigen::Index k = c; k < a.corner.rows(); ++k)
      set(finder, places[static_cast<std::size_t>(kept + k)], place, a.corner(k, c));
  }
}

}  // namespace bielle
