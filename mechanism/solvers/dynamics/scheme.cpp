#include "mechanism/solvers/dynamics/scheme.hpp"

#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

Scheme Scheme::generalized_alpha(double rho) {
  if (!(rho >= 0 && rho <= 1)) throw InputError(fmt::format("rho = {} is outside of [0, 1]", rho));
  Scheme s{(2 * rho - 1) / (rho + 1), rho / (rho + 1), 0, 0};
  s.gamma = 0.5 + s.alpha_f - s.alpha_m;
  s.beta = 0.25 * (s.gamma + 0.5) * (s.gamma + 0.5);
  return s;
}

Scheme Scheme::hht(double alpha) {
  if (!(alpha >= 0 && alpha <= 1.0 / 3)) throw InputError(fmt::format("alpha = {} is outside of [0, 1/3]", alpha));
  return {0, alpha, 0.5 + alpha, 0.25 * (1 + alpha) * (1 + alpha)};
}

Scheme Scheme::newmark() { return {0, 0, 0.5, 0.25}; }

double Scheme::most_turn() const { return 0.7 * std::log((gamma + 0.5) / (1.5 - gamma)); }

}  // namespace bielle::mechanism
