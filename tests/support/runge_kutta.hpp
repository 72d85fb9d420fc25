// The classical Runge-Kutta method of order 4 for reference solutions of small equations.
#pragma once

#include <Eigen/Core>

namespace bielle::test {

/// Moves z over h in `steps` steps. @param rate  dz/dt of z
template <class State, class Rate>
void advance_by_runge_kutta(State& z, double h, int steps, const Rate& rate) {
  const double e = h / steps;
  for (int k = 0; k < steps; ++k) {
    const State k1 = rate(z), k2 = rate(State(z + e / 2 * k1)), k3 = rate(State(z + e / 2 * k2)),
                k4 = rate(State(z + e * k3));
    z += e / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
}

}  // namespace bielle::test
