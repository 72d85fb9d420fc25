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

void NearPairs::find(const std::vector<Bound>& bounds, std::vector<int>& near) const {
  struct Range {
    double low, high;
    Vector3 middle;
    double reach;
    int shape;
  };
  thread_local std::vector<Range> ranges;
  thread_local std::vector<int> planes;
  ranges.clear();
  planes.clear();
  near.clear();
  for (int k = 0; k < shapes_; ++k) {
    const Bound& bound = bounds[static_cast<std::size_t>(k)];
    if (std::isinf(bound.reach))
      planes.push_back(k);
    else
      ranges.push_back({bound.middle.x() - bound.reach, bound.middle.x() + bound.reach, bound.middle, bound.reach, k});
  }
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.low < b.low; });
  const auto take = [&](int a, int b) {
    if (const int pair = number(a, b); pair >= 0) near.push_back(pair);
  };
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const Range& one = ranges[k];
    for (std::size_t l = k + 1; l < ranges.size() && ranges[l].low <= one.high; ++l) {
      const double most = one.reach + ranges[l].reach;
      if ((one.middle - ranges[l].middle).squaredNorm() <= most * most) take(one.shape, ranges[l].shape);
    }
    for (const int plane : planes) {
      const Bound& bound = bounds[static_cast<std::size_t>(plane)];
      if (bound.normal.dot(one.middle - bound.middle) <= one.reach) take(one.shape, plane);
    }
  }
  std::sort(near.begin(), near.end());
}

}  // namespace bielle::mechanism
