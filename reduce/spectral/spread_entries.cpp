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

template <class Number>
SpreadEntries<Number>::SpreadEntries(const SupernodalFactor& structure, Number* values)
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

template <class Number>
void SpreadEntries<Number>::spread(const BorderedPart& a, std::span<const double> scale, int threads) const {
  const auto scale_of = [&](std::size_t unknown) { return scale.empty() ? 1.0 : scale[unknown]; };
  const std::vector<std::int64_t> places = places_in_order(structure_);
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(a.whole.size), -1);
  for (std::size_t k = 0; k < a.kept.size(); ++k)
    numbers[static_cast<std::size_t>(a.kept[k])] = static_cast<std::int64_t>(k);
#pragma omp parallel num_threads(threads)
  {
    RowFinder finder(structure_);
#pragma omp for schedule(dynamic, 1024)
    for (std::size_t k = 0; k < a.kept.size(); ++k) {
      const auto j = static_cast<std::size_t>(a.kept[k]);
      for (std::int64_t p = a.whole.starts[j]; p < a.whole.starts[j + 1]; ++p) {
        const std::int64_t number = numbers[static_cast<std::size_t>(a.whole.rows[p])];
        if (number < 0) continue;
        const auto other = static_cast<std::size_t>(number);
        set(finder, places[k], places[other], a.whole.values[p] * scale_of(k) * scale_of(other));
      }
    }
  }
  RowFinder finder(structure_);
  const auto kept = static_cast<Eigen::Index>(a.kept.size());
  for (Eigen::Index c = 0; c < a.corner.cols(); ++c) {
    const auto own = static_cast<std::size_t>(kept + c);
    const auto set_entry = [&](Eigen::Index unknown, double value) {
      const auto other = static_cast<std::size_t>(unknown);
      set(finder, places[other], places[own], value * scale_of(other) * scale_of(own));
    };
    for (Eigen::Index k = 0; k < kept; ++k)
      if (a.border(k, c) != 0) set_entry(k, a.border(k, c));
    for (Eigen::Index k = c; k < a.corner.rows(); ++k) set_entry(kept + k, a.corner(k, c));
  }
}

template class SpreadEntries<double>;
template class SpreadEntries<float>;

}  // namespace bielle
