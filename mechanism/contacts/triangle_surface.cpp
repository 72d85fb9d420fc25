#include "mechanism/contacts/triangle_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

TriangleSurface::TriangleSurface(const std::vector<Vector3>& corners) {
  join_corners(corners);
  if (triangles_.empty()) throw InputError("the surface has no triangle with an area");
  find_neighbours();
  find_ridges();
  build_tree();
  for (const Vector3& point : points_) reach_ = std::max(reach_, point.norm());
}

void TriangleSurface::join_corners(const std::vector<Vector3>& corners) {
  Vector3 low = corners.empty() ? Vector3::Zero() : corners.front(), high = low;
  for (const Vector3& p : corners) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  size_ = (high - low).norm();
  middle_ = 0.5 * (low + high);
  // Cells of the size within which corners are joined: near corners are in the same cell or a neighbouring one.
  const double cell = std::max(1e-6 * size_, std::numeric_limits<double>::min());
  std::map<std::array<long, 3>, std::vector<int>> known;
  const auto number = [&](const Vector3& p) {
    std::array<long, 3> at{};
    for (int i = 0; i < 3; ++i) at[static_cast<std::size_t>(i)] = std::lround((p[i] - low[i]) / cell);
    for (long x = -1; x <= 1; ++x)
      for (long y = -1; y <= 1; ++y)
        for (long z = -1; z <= 1; ++z)
          if (const auto found = known.find({at[0] + x, at[1] + y, at[2] + z}); found != known.end())
            for (const int other : found->second)
              if ((points_[static_cast<std::size_t>(other)] - p).norm() <= cell) return other;
    known[at].push_back(static_cast<int>(points_.size()));
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  };
  for (std::size_t k = 0; k + 2 < corners.size(); k += 3) {
    const Vector3 normal = (corners[k + 1] - corners[k]).cross(corners[k + 2] - corners[k]);
    const double longest = std::max((corners[k + 1] - corners[k]).norm(), (corners[k + 2] - corners[k]).norm());
    if (!(normal.norm() > 1e-12 * longest * longest)) continue;  // slivers have no normal
    const Triangle triangle = {number(corners[k]), number(corners[k + 1]), number(corners[k + 2])};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    triangles_.push_back(triangle);
    normals_.push_back(normal.normalized());
  }
}

void TriangleSurface::find_neighbours() {
  std::map<std::pair<int, int>, std::pair<int, int>> open;  // (smaller, larger corner) -> triangle, its edge
  neighbours_.assign(triangles_.size(), {-1, -1, -1});
  around_corner_.resize(points_.size());
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    for (std::size_t e = 0; e < 3; ++e) {
      const Triangle& corners = triangles_[static_cast<std::size_t>(t)];
      around_corner_[static_cast<std::size_t>(corners[e])].push_back(t);
      const std::pair<int, int> edge = std::minmax(corners[e], corners[(e + 1) % 3]);
      const auto found = open.find(edge);
      if (found == open.end()) {
        open[edge] = {t, static_cast<int>(e)};
        continue;
      }
      const auto [other, other_edge] = found->second;
      const Triangle& beyond = triangles_[static_cast<std::size_t>(other)];
      if (beyond[static_cast<std::size_t>(other_edge)] == corners[e]) ++flipped_edges_;  // both have one direction
      neighbours_[static_cast<std::size_t>(t)][e] = other;
      neighbours_[static_cast<std::size_t>(other)][static_cast<std::size_t>(other_edge)] = t;
      open.erase(found);
    }
  open_edges_ = static_cast<int>(open.size());
}

void TriangleSurface::build_tree() {
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0);
  build_node(0, static_cast<int>(order_.size()));
}

int TriangleSurface::build_node(int begin, int end) {
  constexpr int leaf = 4;
  const auto index = tree_.size();
  tree_.push_back({Vector3::Constant(1e300), Vector3::Constant(-1e300), begin, end});
  for (int k = begin; k < end; ++k)
    for (const int corner : triangles_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]) {
      const Vector3& p = points_[static_cast<std::size_t>(corner)];
      tree_[index].low = tree_[index].low.cwiseMin(p);
      tree_[index].high = tree_[index].high.cwiseMax(p);
    }
  if (end - begin <= leaf) return static_cast<int>(index);
  Eigen::Index axis = 0;
  (tree_[index].high - tree_[index].low).maxCoeff(&axis);
  const auto place = [&](int t) {
    const Triangle& c = triangles_[static_cast<std::size_t>(t)];
    double sum = 0;
    for (const int corner : c) sum += points_[static_cast<std::size_t>(corner)][axis];
    return sum;
  };
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return place(a) < place(b); });
  const int left = build_node(begin, middle), right = build_node(middle, end);
  tree_[index].left = left;
  tree_[index].right = right;
  return static_cast<int>(index);
}

/// The method is that of C. Ericson, Real-time collision detection (2005), 5.1.5: cases by the regions around the
/// triangle.
TriangleSurface::Nearest TriangleSurface::nearest(int triangle, const Vector3& p) const {
  const Triangle& corners = triangles_[static_cast<std::size_t>(triangle)];
  const Vector3 &a = points_[static_cast<std::size_t>(corners[0])], &b = points_[static_cast<std::size_t>(corners[1])],
                &c = points_[static_cast<std::size_t>(corners[2])];
  const Vector3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, 3};
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, 4};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, 0};
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, 5};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, 2};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 1};
  const Vector3& n = normals_[static_cast<std::size_t>(triangle)];
  return {p - n * n.dot(ap), -1};
}

Vector3 TriangleSurface::outward(int triangle, int feature) const {
  const auto t = static_cast<std::size_t>(triangle);
  if (feature < 0) return normals_[t];
  if (feature < 3) {
    const int other = neighbours_[t][static_cast<std::size_t>(feature)];
    return other < 0 ? normals_[t] : Vector3(normals_[t] + normals_[static_cast<std::size_t>(other)]);
  }
  const int corner = triangles_[t][static_cast<std::size_t>(feature - 3)];
  Vector3 sum = Vector3::Zero();
  for (const int each : around_corner_[static_cast<std::size_t>(corner)]) {
    const Triangle& corners = triangles_[static_cast<std::size_t>(each)];
    const std::size_t k = corners[0] == corner ? 0 : corners[1] == corner ? 1 : 2;
    const auto point = [&](std::size_t number) -> const Vector3& {
      return points_[static_cast<std::size_t>(corners[number % 3])];
    };
    const Vector3 to = point(k + 1) - point(k), from = point(k + 2) - point(k);
    sum += std::atan2(to.cross(from).norm(), to.dot(from)) * normals_[static_cast<std::size_t>(each)];
  }
  return sum;
}

/// Returns whether the nearest place is also that of the neighbours that share the edge or corner.
bool TriangleSurface::is_local(int triangle, const Nearest& found, const Vector3& point) const {
  if (found.feature < 0) return true;
  const Triangle& corners = triangles_[static_cast<std::size_t>(triangle)];
  const auto same = [&](int other) {
    const Vector3 away = nearest(other, point).foot - found.foot;
    return away.norm() <= 1e-9 * ((point - found.foot).norm() + reach_);
  };
  if (found.feature < 3) {
    const int other = neighbours_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(found.feature)];
    return other < 0 || same(other);
  }
  const auto& around = around_corner_[static_cast<std::size_t>(corners[static_cast<std::size_t>(found.feature - 3)])];
  return std::all_of(around.begin(), around.end(), same);
}

std::vector<int> TriangleSurface::sharing(int triangle, int feature) const {
  const auto t = static_cast<std::size_t>(triangle);
  if (feature < 0) return {triangle};
  if (feature >= 3)
    return around_corner_[static_cast<std::size_t>(triangles_[t][static_cast<std::size_t>(feature - 3)])];
  const int other = neighbours_[t][static_cast<std::size_t>(feature)];
  return other < 0 ? std::vector<int>{triangle} : std::vector<int>{triangle, other};
}

void TriangleSurface::find_nearest(const Vector3& point, double radius, std::vector<Place>& places) const {
  std::vector<int> waiting = {0};
  const std::size_t first = places.size();
  while (!waiting.empty()) {
    const Branch& branch = tree_[static_cast<std::size_t>(waiting.back())];
    waiting.pop_back();
    const Vector3 away = (branch.low - point).cwiseMax(point - branch.high).cwiseMax(0);
    if (away.squaredNorm() > radius * radius) continue;
    if (branch.left >= 0) {
      waiting.push_back(branch.left);
      waiting.push_back(branch.right);
      continue;
    }
    for (int k = branch.begin; k < branch.end; ++k) {
      const int t = order_[static_cast<std::size_t>(k)];
      const Nearest found = nearest(t, point);
      if ((point - found.foot).norm() > radius || !is_local(t, found, point)) continue;
      // Edges and corners are found once from each of their triangles.
      const bool known = std::any_of(places.begin() + static_cast<std::ptrdiff_t>(first), places.end(),
                                     [&](const Place& p) { return (p.foot - found.foot).norm() <= 1e-9 * reach_; });
      if (known) continue;
      const Triangle& corners = triangles_[static_cast<std::size_t>(t)];
      const auto corner = [&](int number) -> const Vector3& {
        return points_[static_cast<std::size_t>(corners[static_cast<std::size_t>(number % 3)])];
      };
      Place place{found.feature < 0   ? Place::Kind::face
                  : found.feature < 3 ? Place::Kind::edge
                                      : Place::Kind::corner,
                  found.foot, outward(t, found.feature), found.foot, found.foot};
      if (place.kind != Place::Kind::face) place.from = corner(found.feature);
      if (place.kind == Place::Kind::edge) place.to = corner(found.feature + 1);
      places.push_back(place);
    }
  }
}

}  // namespace bielle::mechanism
