#include "reduce/spectral/child_update.hpp"

#include <algorithm>

namespace bielle {

namespace {

/// Where the rows below a child stand among those of its parent.
std::vector<std::int64_t> places_in_parent(const SupernodeShape& child, const SupernodeShape& parent) {
  std::vector<std::int64_t> places(static_cast<std::size_t>(child.below()));
  std::int64_t at = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::int64_t row = child.row_numbers[child.width + static_cast<std::int64_t>(k)];
    if (row < parent.first + parent.width) at = row - parent.first;
    while (parent.row_numbers[at] != row) ++at;
    places[k] = at;
  }
  return places;
}

}  // namespace

ChildUpdate::ChildUpdate(const double* update, const SupernodeShape& child, const SupernodeShape& parent)
    : update_(update), panels_{child.below()}, places_(places_in_parent(child, parent)), runs_(runs_of(places_)) {}

std::vector<ChildUpdate::Run> ChildUpdate::runs_of(const std::vector<std::int64_t>& places) {
  std::vector<Run> runs;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto row = static_cast<std::int64_t>(k);
    if (runs.empty() || places[k] - row != runs.back().shift) runs.push_back({row, row, places[k] - row});
    runs.back().end = row + 1;
  }
  return runs;
}

void ChildUpdate::add_to(const Front& to, std::int64_t first, std::int64_t end) const {
  const auto place = std::lower_bound(places_.begin(), places_.end(), first);
  auto own = std::upper_bound(runs_.begin(), runs_.end(), place - places_.begin(),
                              [](std::int64_t k, const Run& run) { return k < run.end; });
  for (auto k = place - places_.begin(); k < panels_.below && places_[static_cast<std::size_t>(k)] < end; ++k) {
    if (k == own->end) ++own;
    const std::int64_t panel = k / panels_.width(), above = panel * panels_.width();
    const double* const source = update_ + panels_.offset(panel) + (k - above) * panels_.rows(panel) - above;
    double* const target = to.column(k + own->shift);
    for (std::int64_t i = k; i < own->end; ++i) target[i + own->shift] += source[i];
    for (auto run = own + 1; run != runs_.end(); ++run) {
      double* const shifted = target + run->shift;
      for (std::int64_t i = run->begin; i < run->end; ++i) shifted[i] += source[i];
    }
  }
}

}  // namespace bielle
