#include "mechanism/system/shared_work.hpp"

#include <algorithm>

namespace bielle::mechanism {
namespace {

/// A member with at least this many local rows is a separate piece of work.
constexpr int least_rows = 30;

/// A residual or tangent takes a time in proportion to the entries of the local matrix, some nanoseconds for each
/// entry. Waking another thread takes some microseconds: at least this many entries of work must be moved to other
/// threads.
constexpr double least_saving = 4000;

}  // namespace

void SharedWork::complete() {
  is_costly_.assign(acting_.size(), false);
  costly_.clear();
  evaluation_size_ = {};
  double all = 0, most = 0;
  const auto cost = [&](std::size_t member) {
    const double rows = unknowns_.slots()[member].size();
    return rows * rows;
  };
  for (std::size_t m = 0; m < acting_.size(); ++m) {
    if (!acting_[m].acts) continue;
    all += cost(m);
    if (acting_[m].in_blocks)
      evaluation_size_.block_rows += unknowns_.slots()[m].size();
    else
      evaluation_size_.dense_entries += cost(m);
    // Blocks that are added in place have no buffer of their own.
    if (acting_[m].in_blocks || unknowns_.slots()[m].own_size() < least_rows) continue;
    is_costly_[m] = true;
    costly_.push_back(m);
    most = std::max(most, cost(m));
  }
  std::stable_sort(costly_.begin(), costly_.end(), [&](std::size_t a, std::size_t b) { return cost(a) > cost(b); });
  row_begin_.assign(1, 0);
  for (const std::size_t m : costly_) row_begin_.push_back(row_begin_.back() + unknowns_.slots()[m].size());
  worthwhile_ = all - std::max(most, all / 2) >= least_saving;
}

}  // namespace bielle::mechanism
