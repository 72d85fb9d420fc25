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
      ranges.push_back({bound.middle.x() - bound.reach, bound.middle.x() + bound.reach, k});
  }
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) { return a.low < b.low; });
  const auto take = [&](int a, int b) {
    const int pair = number(a, b);
    if (pair >= 0 && apart(bounds[static_cast<std::size_t>(a)], bounds[static_cast<std::size_t>(b)]) <= 0)
      near.push_back(pair);
  };
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    for (std::size_t l = k + 1; l < ranges.size() && ranges[l].low <= ranges[k].high; ++l)
      take(ranges[k].shape, ranges[l].shape);
    for (const int plane : planes) take(ranges[k].shape, plane);
  }
  std::sort(near.begin(), near.end());
}

}  // namespace bielle::mechanism
