#include "mechanism/contacts/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bielle::mechanism {

NearPairs::NearPairs(int shapes, const std::vector<std::pair<int, int>>& pairs)
    : shapes_(shapes), partners_(pairs.size()), begin_(static_cast<std::size_t>(shapes) + 1, 0) {
  for (const auto& [a, b] : pairs) ++begin_[static_cast<std::size_t>(a) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t k = 0; k < pairs.size(); ++k)
    partners_[next[static_cast<std::size_t>(pairs[k].first)]++] = {pairs[k].second, static_cast<int>(k)};
  for (std::size_t a = 0; a + 1 < begin_.size(); ++a)
    std::sort(partners_.begin() + static_cast<std::ptrdiff_t>(begin_[a]),
              partners_.begin() + static_cast<std::ptrdiff_t>(begin_[a + 1]),
              [](const Partner& one, const Partner& other) { return one.shape < other.shape; });
}

int NearPairs::number(int a, int b) const {
  const auto first = static_cast<std::size_t>(std::min(a, b));
  const int second = std::max(a, b);
  const auto begin = partners_.begin() + static_cast<std::ptrdiff_t>(begin_[first]),
             end = partners_.begin() + static_cast<std::ptrdiff_t>(begin_[first + 1]);
  const auto found =
      std::lower_bound(begin, end, second, [](const Partner& each, int wanted) { return each.shape < wanted; });
  return found != end && found->shape == second ? found->pair : -1;
}

double NearPairs::apart(const Bound& a, const Bound& b) {
  if (std::isinf(a.reach)) return a.normal.dot(b.middle - a.middle) - b.reach;
  if (std::isinf(b.reach)) return b.normal.dot(a.middle - b.middle) - a.reach;
  return (a.middle - b.middle).norm() - a.reach - b.reach;
}

const NearPairs::Sorted& NearPairs::sort(const std::vector<Bound>& bounds) const {
  thread_local Sorted sorted;
  sorted.ranges.clear();
  sorted.planes.clear();
  Eigen::AlignedBox3d box;
  for (int k = 0; k < shapes_; ++k) {
    const Bound& bound = bounds[static_cast<std::size_t>(k)];
    if (std::isinf(bound.reach))
      sorted.planes.push_back(k);
    else
      box.extend(bound.middle);
  }
  Eigen::Index axis = 0;
  if (!box.isEmpty()) box.sizes().maxCoeff(&axis);
  for (int k = 0; k < shapes_; ++k)
    if (const Bound& bound = bounds[static_cast<std::size_t>(k)]; !std::isinf(bound.reach))
      sorted.ranges.push_back({bound.middle[axis] - bound.reach, bound.middle[axis] + bound.reach, k});
  std::sort(sorted.ranges.begin(), sorted.ranges.end(), [](const Range& a, const Range& b) { return a.low < b.low; });
  return sorted;
}

void NearPairs::find(const std::vector<Bound>& bounds, std::vector<int>& near) const {
  near.clear();
  for_each_within(bounds, 0, [&](int pair) { near.push_back(pair); });
  std::sort(near.begin(), near.end());
}

}  // namespace bielle::mechanism
