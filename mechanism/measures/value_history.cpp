#include "mechanism/measures/value_history.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {
namespace {

enum HistoryMemory : Eigen::Index { number_of_values, number_of_breaks, first_time };

/// A view of the stored values.
struct StoredValues {
  const double* data;
  int count;
  double time(int k) const { return data[first_time + 2 * k]; }
  double value(int k) const { return data[first_time + 1 + 2 * k]; }
  double secant(int k) const { return (value(k + 1) - value(k)) / length(k); }
  double length(int k) const { return time(k + 1) - time(k); }
  /// Returns whether values k and k + 1 exist, with a smooth part of the motion between them.
  bool smooth(int k) const { return k >= 0 && k + 1 < count && length(k) > 0; }
  bool jumps(int k) const { return length(k) == 0 && value(k) != value(k + 1); }
  /// Returns the slope at value k of the parabola through it and its neighbours, or through the nearest three values on
  /// this side of a discontinuity. @param k  an end of a smooth part
  double slope(int k) const {
    const int middle = smooth(k - 1) && smooth(k) ? k : smooth(k) ? k + 1 : k - 1;
    if (!smooth(middle - 1)) return secant(middle);
    if (!smooth(middle)) return secant(middle - 1);
    const double a = length(middle - 1), b = length(middle), s = secant(middle - 1), r = secant(middle);
    const double curvature = (r - s) / (a + b);
    return k < middle ? s - curvature * a : k > middle ? r + curvature * b : s + curvature * a;
  }
  /// Returns the last value whose time is not after `at`, a time that is not before that of the first value.
  int last_until(double at) const {
    int k = 0;
    for (int above = count; above - k > 1;) {
      const int middle = (k + above) / 2;
      (time(middle) <= at ? k : above) = middle;
    }
    return k;
  }
  double largest() const {
    double most = 0;
    for (int k = 0; k < count; ++k) most = std::max(most, std::abs(value(k)));
    return most;
  }
  int breaks() const {
    int sum = 0;
    for (int k = 0; k + 1 < count; ++k) sum += length(k) == 0 ? 1 : 0;
    return sum;
  }
};

StoredValues stored_in(const Eigen::Ref<const VectorX>& memory) {
  return {memory.data(), static_cast<int>(memory[number_of_values])};
}

}  // namespace

ValueHistory::Past ValueHistory::before(double now, const Eigen::Ref<const VectorX>& memory) const {
  const StoredValues past = stored_in(memory);
  if (past.count == 0) return {0, 1};
  const double at = now - span_;
  if (at <= past.time(0)) return {past.value(0), 0};
  const int last = past.count - 1;
  if (at > past.time(last)) {
    const double h = now - past.time(last), s = at - past.time(last);
    if (!past.smooth(last - 1)) return {past.value(last) * (1 - s / h), s / h};
    const double a = past.length(last - 1);
    const double weight = s * (s + a) / (h * (h + a));  // weight in Lagrange's form
    const double of_last = (s + a) * (h - s) / (a * h), of_first = s * (s - h) / (a * (a + h));
    return {of_last * past.value(last) + of_first * past.value(last - 1), weight};
  }
  int k = past.last_until(at);
  if (past.time(k) == at) {  // the value before a jump is used
    while (k > 0 && past.length(k - 1) == 0) --k;
    return {past.value(k), 0};
  }
  const double h = past.length(k), s = (at - past.time(k)) / h;
  const double f1 = s * s * (3 - 2 * s), f0 = s * (1 - s) * (1 - s), f2 = s * s * (s - 1);
  return {past.value(k) + f1 * (past.value(k + 1) - past.value(k)) + h * (f0 * past.slope(k) + f2 * past.slope(k + 1)),
          0};
}

bool ValueHistory::store(double now, double value, Eigen::Ref<VectorX> memory) const {
  const StoredValues past = stored_in(memory);
  int count = past.count;
  while (count > 0 && past.time(count - 1) > now) --count;
  const bool replaces = count > 0 && past.time(count - 1) == now;
  const bool near = !replaces && count >= 2 && past.length(count - 2) > 0 && past.length(count - 2) < span_ / points_;
  if (replaces || near) --count;
  // One value before the delayed time and its neighbour are needed by the interpolation.
  int unused = 0;
  while (unused + 2 < count && past.time(unused + 2) <= now - span_) ++unused;
  // Places are needed for the next value, and for the one after a jump there.
  if (count - unused + 2 > capacity()) return false;
  double* values = memory.data() + first_time;
  if (unused > 0) std::copy(values + 2 * unused, values + 2 * count, values);
  count -= unused;
  values[2 * count] = now;
  values[2 * count + 1] = value;
  memory[number_of_values] = count + 1;
  if (memory[number_of_breaks] != 0) memory[number_of_breaks] = stored_in(memory).breaks();
  return true;
}

bool ValueHistory::store_after(double time, double value, Eigen::Ref<VectorX> memory) const {
  const StoredValues past = stored_in(memory);
  if (past.count == 0) return store(time, value, memory);
  const bool again = past.count >= 2 && past.time(past.count - 1) == time && past.length(past.count - 2) == 0;
  const int before = past.count - (again ? 2 : 1);
  constexpr double rounding = 1e-9;
  const double change = std::abs(value - past.value(before));
  const bool jumps = change > rounding * std::max(past.largest(), std::abs(value));
  const bool near = before > 0 && time - past.time(before - 1) < span_ / points_;
  if (!jumps && near && !again) return true;  // the values next to the kink are dense already
  if (before + 2 > capacity()) return false;
  double* values = memory.data() + first_time;
  values[2 * before] = values[2 * before + 2] = time;
  values[2 * before + 3] = jumps ? value : values[2 * before + 1];
  memory[number_of_values] = before + 2;
  if (!again) memory[number_of_breaks] += 1;
  return true;
}

double ValueHistory::next_jump(double after, const Eigen::Ref<const VectorX>& memory) const {
  const StoredValues past = stored_in(memory);
  if (memory[number_of_breaks] == 0 || past.count < 2) return std::numeric_limits<double>::infinity();
  const double from = after - span_;
  for (int k = from > past.time(0) ? std::max(past.last_until(from) - 1, 0) : 0; k + 1 < past.count; ++k)
    if (past.jumps(k) && past.time(k) + span_ > after) return past.time(k) + span_;
  return std::numeric_limits<double>::infinity();
}

bool ValueHistory::knows(const Eigen::Ref<const VectorX>& memory) const {
  const double count = memory[number_of_values];
  if (!(count >= 0 && count <= capacity() && count == std::floor(count))) return false;
  const StoredValues past = stored_in(memory);
  for (int k = 0; k + 1 < past.count; ++k) {
    if (!(past.length(k) >= 0)) return false;
    if (k > 0 && past.length(k - 1) == 0 && past.length(k) == 0) return false;
  }
  return memory[number_of_breaks] == past.breaks();
}

}  // namespace bielle::mechanism
