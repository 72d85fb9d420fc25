#include "mechanism/contacts/core_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/contacts/pair_of_shapes.hpp"

namespace bielle::mechanism {
namespace {

/// Halves of the segments whose sum is a core.
struct Segments {
  std::array<Vector3, 6> half;
  std::size_t count = 0;
  void add(const PlacedShape<double>& placed) {
    const ContactShape& shape = *placed.shape;
    if (shape.kind == ContactShape::Kind::capsule) half[count++] = shape.half_length * value_of(placed.axes[2]);
    if (shape.kind == ContactShape::Kind::box)
      for (std::size_t k = 0; k < 3; ++k)
        half[count++] = (shape.half[static_cast<Eigen::Index>(k)] - shape.rounding) * value_of(placed.axes[k]);
  }
};

/// Returns the point of a core that is nearest to another point. @param begin,end  range of its segments
Vector3 nearest_of_core(const Segments& segments, std::size_t begin, std::size_t end, const Vector3& middle,
                        const Vector3& point) {
  Vector3 nearest = middle;
  for (std::size_t k = begin; k < end; ++k) {
    const Vector3& g = segments.half[k];
    nearest += std::clamp(g.dot(point - middle) / g.squaredNorm(), -1.0, 1.0) * g;
  }
  return nearest;
}

}  // namespace

std::optional<CoreOverlap> overlap_of_cores(const PlacedShape<double>& first, const PlacedShape<double>& second) {
  Segments segments;
  segments.add(first);
  const std::size_t of_first = segments.count;
  segments.add(second);
  // A shape without segments is neither box nor capsule; two lines have no interior.
  if (of_first == 0 || segments.count == of_first || segments.count < 3) return {};
  const Vector3 a = value_of(first.origin), b = value_of(second.origin), d = b - a;
  CoreOverlap overlap{std::numeric_limits<double>::infinity(), Vector3::Zero(), Vector3::Zero()};
  for (std::size_t i = 0; i < segments.count; ++i)
    for (std::size_t j = i + 1; j < segments.count; ++j) {
      Vector3 n = segments.half[i].cross(segments.half[j]);
      const double length = n.norm();
      // Parallel segments span no face.
      if (length <= 1e-9 * segments.half[i].norm() * segments.half[j].norm()) continue;
      n /= d.dot(n) < 0 ? -length : length;
      double way = -n.dot(d);
      for (std::size_t k = 0; k < segments.count; ++k) way += std::abs(n.dot(segments.half[k]));
      if (way <= 0) return {};
      if (way < overlap.depth) {
        overlap.depth = way;
        overlap.normal = n;
      }
    }
  overlap.place =
      0.5 * (nearest_of_core(segments, 0, of_first, a, b) + nearest_of_core(segments, of_first, segments.count, b, a));
  return overlap;
}

Touch<double> deepest_of_edge(const Triple<double>& a, const Triple<double>& b, double skin,
                              const PlacedShape<double>& core, bool edge_on_second) {
  const auto at = [&](double t) { return distance_to_core(a + t * (b - a), core); };
  double low = 0, high = 1;
  constexpr int thirds = 60;  // the last interval is below 1e-10 of the length
  for (int k = 0; k < thirds; ++k) {
    const double one = low + (high - low) / 3, other = high - (high - low) / 3;
    if (at(one).distance < at(other).distance)
      high = other;
    else
      low = one;
  }
  return touch_of(at(0.5 * (low + high)), skin, core.shape->skin(), edge_on_second);
}

}  // namespace bielle::mechanism
