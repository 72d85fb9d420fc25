#include "mechanism/solvers/linearised/periodic_deviation.hpp"

#include <cmath>
#include <numbers>

namespace bielle::mechanism {

VectorX PeriodicDeviation::functions(double psi, int derivative) const {
  VectorX e(2 * harmonics + 1);
  e[0] = derivative == 0 ? 1 : 0;
  for (int m = 1; m <= harmonics; ++m) {
    // Each derivative by time multiplies by m rate and advances the phase by a quarter of a turn.
    const double size = std::numbers::sqrt2 * std::pow(m * rate, derivative), phase = m * psi;
    const double c = std::cos(phase), s = std::sin(phase);
    e[2 * m - 1] = size * (derivative == 0 ? c : derivative == 1 ? -s : -c);
    e[2 * m] = size * (derivative == 0 ? s : derivative == 1 ? c : -s);
  }
  return e;
}

void PeriodicDeviation::extend(int more) {
  const Eigen::Index before = q.cols(), columns = 2 * more + 1;
  q.conservativeResize(Eigen::NoChange, columns);
  l.conservativeResize(Eigen::NoChange, columns);
  q.rightCols(columns - before).setZero();
  l.rightCols(columns - before).setZero();
  harmonics = more;
}

VectorX PeriodicDeviation::sizes(int unknown) const {
  VectorX size(harmonics + 1);
  size[0] = std::abs(q(unknown, 0));
  for (int m = 1; m <= harmonics; ++m)
    size[m] = std::numbers::sqrt2 * std::hypot(q(unknown, 2 * m - 1), q(unknown, 2 * m));
  return size;
}

}  // namespace bielle::mechanism
