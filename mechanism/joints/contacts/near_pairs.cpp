#include "mechanism/joints/contacts/near_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

NearPairs::NearPairs(int shapes, const std::vector<std::pair<int, int>>& pairs)
    : shapes_(shapes), number_(static_cast<std::size_t>(shapes) * static_cast<std::size_t>(shapes), -1) {
  for (std::size_t k = 0; k < pairs.size(); ++k)
    number_[static_cast<std::size_t>(pairs[k].first) * static_cast<std::size_t>(shapes) +
            static_cast<std::size_t>(pairs[k].second)] = static_cast<int>(k);
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
