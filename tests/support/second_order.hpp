// The convergence of a second-order scheme to a reference, for benchmarks with known numbers.
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

namespace bielle::test {

/// Runs `error` (h -> computed minus reference, a vector) at h, h/2, h/4, ... and checks two things: each halving
/// divides the error by four, and the remainder after Richardson's extrapolation of the two finest is small relative to
/// the finest error, so that the scheme converges to the reference.
/// @param margin  tolerance of the observed order, which is 2 up to the next term of the error's series
template <class Error>
void check_second_order(const Error& error, double h, int halvings, double margin = 0.1, double left = 0.1) {
  Eigen::VectorXd coarse = error(h), before = coarse;
  for (int k = 0; k < halvings; ++k) {
    h /= 2;
    before = coarse;
    coarse = error(h);
    INFO("h = " << h << ": error " << before.norm() << " -> " << coarse.norm());
    CHECK(std::log2(before.norm() / coarse.norm()) == Approx(2).margin(margin));
  }
  const Eigen::VectorXd rest = (4 * coarse - before) / 3;
  INFO("left by extrapolation: " << rest.norm() << " of " << coarse.norm());
  CHECK(rest.norm() < left * coarse.norm());
}

}  // namespace bielle::test
