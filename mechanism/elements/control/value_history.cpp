#include "mechanism/elements/control/value_history.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {
namespace {

/// A view of the stored values.
struct StoredValues {
  const double* data;
  int count;
  double time(int k) const { return data[1 + 2 * k]; }
  double value(int k) const { return data[2 + 2 * k]; }
  double secant(int k) const { return (value(k + 1) - value(k)) / (time(k + 1) - time(k)); }
  double length(int k) const { return time(k + 1) - time(k); }
  /// Slope at value k of the parabola through it and its neighbours, or through the nearest three values.
  double slope(int k) const {
    if (count == 2) return secant(0);
    const int middle = std::clamp(k, 1, count - 2);
    const double a = length(middle - 1), b = length(middle), s = secant(middle - 1), r = secant(middle);
    const double curvature = (r - s) / (a + b);
    return k < middle ? s - curvature * a : k > middle ? r + curvature * b : s + curvature * a;
  }
};

StoredValues stored_in(const Eigen::Ref<const VectorX>& memory) { return {memory.data(), static_cast<int>(memory[0])}; }

}  // namespace

ValueHistory::Past ValueHistory::before(double now, const Eigen::Ref<const VectorX>& memory) const {
  const StoredValues past = stored_in(memory);
  if (past.count == 0) return {0, 1};
  const double at = now - span_;
  if (at <= past.time(0)) return {past.value(0), 0};
  const int last = past.count - 1;
  if (at > past.time(last)) {
    const double h = now - past.time(last), s = at - past.time(last);
    if (last == 0) return {past.value(0) * (1 - s / h), s / h};
    const double a = past.length(last - 1);
    const double weight = s * (s + a) / (h * (h + a));  // weight in Lagrange's form
    const double of_last = (s + a) * (h - s) / (a * h), of_first = s * (s - h) / (a * (a + h));
    return {of_last * past.value(last) + of_first * past.value(last - 1), weight};
  }
  int k = 0;
  for (int above = last; above - k > 1;) {
    const int middle = (k + above) / 2;
    (past.time(middle) <= at ? k : above) = middle;
  }
  const double h = past.length(k), s = (at - past.time(k)) / h;
  const double f1 = s * s * (3 - 2 * s), f0 = s * (1 - s) * (1 - s), f2 = s * s * (s - 1);
  return {past.value(k) + f1 * (past.value(k + 1) - past.value(k)) + h * (f0 * past.slope(k) + f2 * past.slope(k + 1)),
          0};
}

void ValueHistory::store(double now, double value, Eigen::Ref<VectorX> memory) const {
  int count = static_cast<int>(memory[0]);
  double* values = memory.data() + 1;  // pairs of time and value
  while (count > 0 && values[2 * (count - 1)] >= now) --count;
  const bool near = count >= 2 && values[2 * (count - 1)] - values[2 * (count - 2)] < span_ / points_;
  if (near) --count;
  // One value before the delayed time and its neighbour are needed by the interpolation.
  int unused = 0;
  while (unused + 2 < count && values[2 * (unused + 2)] <= now - span_) ++unused;
  // Distances of T/points at least leave room; only rounding could fill it.
  unused = std::max(unused, count + 1 - (points_ + 6));
  if (unused > 0) std::copy(values + 2 * unused, values + 2 * count, values);
  count -= std::max(unused, 0);
  values[2 * count] = now;
  values[2 * count + 1] = value;
  memory[0] = count + 1;
}

bool ValueHistory::knows(const Eigen::Ref<const VectorX>& memory) const {
  if (!(memory[0] >= 0 && memory[0] <= points_ + 6 && memory[0] == std::floor(memory[0]))) return false;
  const StoredValues past = stored_in(memory);
  for (int k = 0; k + 1 < past.count; ++k)
    if (!(past.length(k) > 0)) return false;
  return true;
}

}  // namespace bielle::mechanism
