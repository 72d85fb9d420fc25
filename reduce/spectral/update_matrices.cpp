#include "reduce/spectral/update_matrices.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

#include "reduce/spectral/huge_pages.hpp"
#include "reduce/spectral/supernodal_solver.hpp"

namespace bielle {

namespace {

std::int64_t update_numbers(const SupernodalFactor& structure, std::size_t s) {
  const std::int64_t rows = structure.row_starts[s + 1] - structure.row_starts[s];
  return UpdatePanels{rows - (structure.columns[s + 1] - structure.columns[s])}.size();
}

/// The children of each supernode so that their stack stays low: those first whose elimination needs most more than it
/// leaves (J. W. H. Liu, ACM Trans. Math. Software 12 (1986) 249).
std::vector<std::vector<std::int64_t>> sparing_order(const std::vector<std::int64_t>& sizes,
                                                     const EliminationTree& tree) {
  std::vector<std::vector<std::int64_t>> children = tree.children;
  std::vector<std::int64_t> peaks(sizes.size(), 0);
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const auto gain = [&](std::int64_t c) {
      return peaks[static_cast<std::size_t>(c)] - sizes[static_cast<std::size_t>(c)];
    };
    std::stable_sort(children[s].begin(), children[s].end(),
                     [&](std::int64_t a, std::int64_t b) { return gain(a) > gain(b); });
    std::int64_t left = 0;
    for (const std::int64_t c : children[s]) {
      peaks[s] = std::max(peaks[s], left + peaks[static_cast<std::size_t>(c)]);
      left += sizes[static_cast<std::size_t>(c)];
    }
    peaks[s] = std::max(peaks[s], left + sizes[s]);
  }
  return children;
}

}  // namespace

template <class IsOwn>
UpdatePlan::StackSizes UpdatePlan::plan(std::int64_t root, const EliminationTree& tree, const IsOwn& is_own,
                                        std::vector<std::int64_t>& order) {
  StackSizes top{}, peak{};
  struct Visit {
    std::int64_t s;
    std::size_t next_child;
  };
  std::vector<Visit> visits{{root, 0}};
  while (!visits.empty()) {
    const auto s = static_cast<std::size_t>(visits.back().s);
    if (visits.back().next_child < children_[s].size()) {
      const std::int64_t child = children_[s][visits.back().next_child++];
      if (is_own(child)) visits.push_back({child, 0});
      continue;
    }
    visits.pop_back();
    order.push_back(static_cast<std::int64_t>(s));
    if (visits.empty() && tree.parents[s] >= 0) {
      places_[s] = {-1, 0};
      apart_.push_back(static_cast<std::int64_t>(s));
    } else {
      const auto own = static_cast<std::size_t>(parities_[s]);
      places_[s] = {parities_[s], top[own]};
      top[own] += sizes_[s];
      peak[own] = std::max(peak[own], top[own]);
    }
    for (const std::int64_t child : children_[s])
      if (is_own(child)) top[static_cast<std::size_t>(1 - parities_[s])] -= sizes_[static_cast<std::size_t>(child)];
  }
  return peak;
}

UpdatePlan::UpdatePlan(const SupernodalFactor& structure, const EliminationTree& tree, const TreeShares& shares) {
  const std::size_t count = tree.parents.size();
  sizes_.resize(count);
  for (std::size_t s = 0; s < count; ++s) sizes_[s] = update_numbers(structure, s);
  children_ = sparing_order(sizes_, tree);
  parities_.resize(count);
  for (std::size_t s = count; s-- > 0;)
    parities_[s] = tree.parents[s] < 0 ? 0 : 1 - parities_[static_cast<std::size_t>(tree.parents[s])];
  places_.resize(count);
  const auto enlarge = [](StackSizes& sizes, const StackSizes& needed) {
    for (std::size_t parity = 0; parity < 2; ++parity) sizes[parity] = std::max(sizes[parity], needed[parity]);
  };
  for (const std::int64_t root : shares.roots) {
    orders_.emplace_back();
    enlarge(of_subtrees_, plan(
                              root, tree, [](std::int64_t) { return true; }, orders_.back()));
  }
  const auto is_above = [&](std::int64_t s) { return static_cast<bool>(shares.is_above[static_cast<std::size_t>(s)]); };
  orders_.emplace_back();
  for (std::size_t s = 0; s < count; ++s)
    if (shares.is_above[s] && tree.parents[s] < 0)
      enlarge(of_above_, plan(static_cast<std::int64_t>(s), tree, is_above, orders_.back()));
}

std::int64_t UpdatePlan::numbers(int threads) const {
  std::int64_t apart = 0;
  for (const std::int64_t s : apart_) apart += sizes_[static_cast<std::size_t>(s)];
  return apart + std::max(threads * (of_subtrees_[0] + of_subtrees_[1]), of_above_[0] + of_above_[1]);
}

void UpdateMemory::Freed::operator()(double* memory) const { std::free(memory); }

UpdateMemory::Block UpdateMemory::take(std::int64_t numbers) {
  if (numbers == 0) return nullptr;
  void* memory = allocate_in_huge_pages(sizeof(double) * static_cast<std::size_t>(numbers));
  if (memory == nullptr) throw std::bad_alloc();
  return Block(static_cast<double*>(memory));
}

UpdateMemory::UpdateMemory(const UpdatePlan& plan, int threads) : plan_(plan), apart_(plan.sizes_.size()) {
  for (int thread = 0; thread < threads; ++thread) stacks_.push_back(take(plan.of_subtrees_));
  for (const std::int64_t s : plan.apart_)
    apart_[static_cast<std::size_t>(s)] = take(plan.sizes_[static_cast<std::size_t>(s)]);
}

void UpdateMemory::leave_subtrees() {
  stacks_.clear();
  stacks_.push_back(take(plan_.of_above_));
}

double* UpdateMemory::of(std::int64_t s, int worker) const {
  const UpdatePlan::Place& place = plan_.places_[static_cast<std::size_t>(s)];
  if (place.parity < 0) return apart_[static_cast<std::size_t>(s)].get();
  return stacks_[static_cast<std::size_t>(worker)][static_cast<std::size_t>(place.parity)].get() + place.offset;
}

void UpdateMemory::free(std::int64_t s) { apart_[static_cast<std::size_t>(s)].reset(); }

}  // namespace bielle
