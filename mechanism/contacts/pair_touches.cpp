#include "mechanism/contacts/pair_touches.hpp"

#include <algorithm>
#include <limits>

#include "mechanism/contacts/core_overlap.hpp"
#include "mechanism/contacts/nearest_on_surface.hpp"

namespace bielle::mechanism {
namespace {

using Kind = ContactShape::Kind;
using Twelve = AutoDiff<12, 1>;

// Numbers of touches: those of corners begin at 0, those of crossings and tips at these values.
constexpr int crossings = 100000, tips = 1 << 29;

/// The potential V = k p^(n+1)/(n+1) and its derivative V'.
template <class T>
struct Spring {
  T potential{}, force{};
  Spring(const NormalLaw& law, const T& depth) {
    if (value_of(depth) <= 0) return;
    force = T(law.stiffness) * pow(depth, law.exponent);
    potential = T(1 / (law.exponent + 1)) * (depth * force);
  }
};

/// Collects touches and their forces.
template <class T>
class Gathered {
 public:
  Gathered(const NormalLaw& law, PairTouches<T>& result) : law_(law), result_(result) {}

  /// @returns its number, -1: no contact
  int add(Touch<T> touch, int id) {
    if (value_of(touch.depth) <= 0) return -1;
    const Spring<T> spring(law_, touch.depth);
    touch.force = touch.load = spring.force;
    touch.id = id;
    result_.potential += spring.potential;
    result_.touches.push_back(touch);
    return static_cast<int>(result_.touches.size()) - 1;
  }

  /// Adds two crossing edges with the potential V(p) prod_i (1 - V(p_i)/V(p)).
  /// @param ends  touches of the four ends i with the other edge @param numbers  numbers of the touches of these
  ///              corners, -1: none
  void add_crossing(Touch<T> crossing, std::array<Touch<T>, 4> ends, const std::array<int, 4>& numbers, int id) {
    if (value_of(crossing.depth) <= 0) return;
    const Spring<T> whole(law_, crossing.depth);
    std::array<T, 4> left, slope;  // 1 - V_i/V; V_i'
    for (std::size_t k = 0; k < 4; ++k) {
      const Spring<T> end(law_, ends[k].depth);
      left[k] = T(1) - end.potential / whole.potential;
      slope[k] = end.force;
    }
    const auto product_without = [&](std::size_t without) {
      T product(1);
      for (std::size_t k = 0; k < 4; ++k)
        if (k != without) product *= left[k];
      return product;
    };
    T share = product_without(4);
    result_.potential += whole.potential * share;
    for (std::size_t k = 0; k < 4; ++k) {
      if (value_of(ends[k].depth) <= 0) continue;
      const T others = product_without(k);
      share += (T(1) - left[k]) * others;
      ends[k].force = -(slope[k] * others);
      unload(numbers[k], ends[k].force);
      result_.touches.push_back(ends[k]);
    }
    crossing.force = crossing.load = whole.force * share;
    crossing.id = id;
    result_.touches.push_back(crossing);
  }

  /// Returns the nearest to a touch among the touches of one corner at several places; -1: none.
  int nearest_of(const std::vector<int>& numbers, const Touch<T>& touch) const {
    const auto away = [&](int k) {
      return value_of(result_.touches[static_cast<std::size_t>(k)].place - touch.place).squaredNorm();
    };
    const auto nearest =
        std::min_element(numbers.begin(), numbers.end(), [&](int a, int b) { return away(a) < away(b); });
    return nearest == numbers.end() ? -1 : *nearest;
  }

 private:
  /// Removes the force that a crossing takes over from a corner from the corner's load.
  void unload(int number, const T& force) {
    if (number < 0) return;
    T& load = result_.touches[static_cast<std::size_t>(number)].load;
    load += force;
    if (value_of(load) < 0) load = T(0);
  }
  const NormalLaw& law_;
  PairTouches<T>& result_;
};

template <class T>
void gather(const PairOfShapes<T>& pair, Gathered<T>& gathered) {
  std::array<std::vector<int>, 2> corner_touch;
  for (const std::size_t side : {0UL, 1UL}) corner_touch[side].assign(pair.shape(side).corners().size(), -1);
  pair.for_each_corner(
      [&](const Touch<T>& touch, std::size_t side, std::size_t corner) {
        corner_touch[side][corner] = gathered.add(touch, static_cast<int>(32 * side + corner));
      },
      Among::touching);
  pair.for_each_crossing(
      [&](std::size_t i, std::size_t j) {
        std::array<Touch<T>, 4> ends;
        std::array<int, 4> numbers;
        for (std::size_t k = 0; k < 4; ++k) {
          const std::size_t side = k / 2;
          const auto corner = static_cast<std::size_t>(pair.shape(side).edges()[side == 0 ? i : j][k % 2]);
          ends[k] = pair.end_on_edge(side, corner, side == 0 ? j : i);
          numbers[k] = corner_touch[side][corner];
        }
        gathered.add_crossing(pair.crossing(i, j), ends, numbers, crossings + static_cast<int>(32 * i + j));
      },
      Among::touching);
}

template <class T>
void gather_on_surface(const PairOfShapes<T>& pair, Gathered<T>& gathered) {
  const OnSurface<T> on(pair);
  const ContactShape& body = *on.body().shape;
  std::vector<std::vector<int>> corner_touches(body.corners().size());
  for (std::size_t k = 0; k < body.corners().size(); ++k)
    on.for_each_place(k, [&](const Touch<T>& touch) {
      const int number = gathered.add(touch, static_cast<int>(32 * on.side() + k));
      if (number >= 0) corner_touches[k].push_back(number);
    });
  if (body.kind == Kind::sphere) return;  // a sphere is compared by its middle only
  const TriangleSurface::Outstanding near = on.outstanding(0);
  std::vector<int> tip_touch;
  for (const int tip : near.tips)
    tip_touch.push_back(on.tip_may_touch(tip) ? gathered.add(on.tip_on_body(tip), tips + tip) : -1);
  const auto touch_of_tip = [&](int tip) {
    const auto found = std::lower_bound(near.tips.begin(), near.tips.end(), tip);
    return found == near.tips.end() || *found != tip ? -1
                                                     : tip_touch[static_cast<std::size_t>(found - near.tips.begin())];
  };
  for (const int ridge : near.ridges)
    for (std::size_t edge = 0; edge < body.edges().size(); ++edge) {
      if (!on.crosses(ridge, edge, body.edge_skin())) continue;
      std::array<Touch<T>, 4> ends;
      std::array<int, 4> numbers;
      for (std::size_t k = 0; k < 2; ++k) {
        const auto corner = static_cast<std::size_t>(body.edges()[edge][k]);
        const int tip = on.triangles().ridges()[static_cast<std::size_t>(ridge)].ends[k];
        ends[k] = on.corner_on_ridge(corner, ridge);
        numbers[k] = gathered.nearest_of(corner_touches[corner], ends[k]);
        ends[2 + k] = on.tip_on_edge(tip, edge);
        numbers[2 + k] = touch_of_tip(tip);
      }
      gathered.add_crossing(on.crossing(ridge, edge), ends, numbers, crossings + 32 * ridge + static_cast<int>(edge));
    }
}

}  // namespace

template <class T>
void find_touches(const PlacedShape<T>& first, const PlacedShape<T>& second, const NormalLaw& law,
                  PairTouches<T>& result) {
  result.touches.clear();
  result.potential = T(0);
  const PairOfShapes<T> pair(first, second);
  Gathered<T> gathered(law, result);
  if (first.shape->kind == Kind::surface || second.shape->kind == Kind::surface)
    gather_on_surface(pair, gathered);
  else
    gather(pair, gathered);
}

template void find_touches(const PlacedShape<double>&, const PlacedShape<double>&, const NormalLaw&,
                           PairTouches<double>&);
template void find_touches(const PlacedShape<Twelve>&, const PlacedShape<Twelve>&, const NormalLaw&,
                           PairTouches<Twelve>&);

Touch<double> find_nearest_place(const PlacedShape<double>& first, const PlacedShape<double>& second) {
  const PairOfShapes<double> pair(first, second);
  if (first.shape->kind == Kind::surface || second.shape->kind == Kind::surface) return nearest_on_surface(pair);
  if (const auto overlap = overlap_of_cores(first, second)) {
    Touch<double> through;
    through.depth = overlap->depth + first.shape->skin() + second.shape->skin();
    through.normal = Triple<double>(overlap->normal);
    through.place = Triple<double>(overlap->place);
    return through;
  }
  Touch<double> nearest;
  nearest.depth = -std::numeric_limits<double>::infinity();
  const auto take = [&](const Touch<double>& touch) {
    if (touch.depth > nearest.depth) nearest = touch;
  };
  pair.for_each_corner([&](const Touch<double>& touch, std::size_t, std::size_t) { take(touch); }, Among::all);
  pair.for_each_crossing([&](std::size_t i, std::size_t j) { take(pair.crossing(i, j)); }, Among::all);
  // An edge may go through a core although its ends are outside.
  for (const std::size_t side : {0UL, 1UL}) {
    const ContactShape &of = pair.shape(side), &other = pair.shape(1 - side);
    const bool round = of.kind == Kind::cylinder || other.kind == Kind::cylinder;
    if (!round || (other.kind != Kind::cylinder && other.kind != Kind::box)) continue;
    for (std::size_t k = 0; k < of.edges().size(); ++k) {
      const Ends<double> ends = pair.edge(side, k);
      const Touch<double> deepest = deepest_of_edge(ends[0], ends[1], of.edge_skin(), pair.placed(1 - side), side == 1);
      if (deepest.depth > of.edge_skin() + other.skin()) take(deepest);
    }
  }
  return nearest;
}

}  // namespace bielle::mechanism
