// Fixed points of linear maps: slowly converging ones, and ones for which plain iteration diverges.
#include <catch2/catch.hpp>

#include "mechanism/solvers/statics/fixed_point.hpp"

using namespace bielle::mechanism;

TEST_CASE("a fixed point is found in about as many iterations as it has slow directions") {
  // G(x) = x* + A (x - x*): plain iteration takes 180 iterations to 1e-8 with 0.9, and diverges with -1.5.
  const VectorX rates = (VectorX(5) << 0.9, -1.5, 0.4, 1e-3, 0).finished();
  const VectorX solution = VectorX::LinSpaced(5, 1, 3);
  FixedPoint iteration((VectorX(5) << 1, 1, 10, 1, 1).finished());
  VectorX x = VectorX::Zero(5);
  int count = 0;
  for (; count < 12 && (x - solution).norm() > 1e-8; ++count)
    x = iteration.next(x, solution + rates.cwiseProduct(x - solution));
  CHECK(count <= 8);
  CHECK((x - solution).norm() <= 1e-8);
  // The iteration stays at the fixed point.
  for (int k = 0; k < 3; ++k) x = iteration.next(x, solution + rates.cwiseProduct(x - solution));
  CHECK((x - solution).norm() <= 1e-8);
}

TEST_CASE("where there is nothing, iteration has nothing to do") {
  FixedPoint iteration(VectorX::Ones(3));
  const VectorX zero = VectorX::Zero(3);
  for (int k = 0; k < 4; ++k) CHECK(iteration.next(zero, zero).isZero(0));
  FixedPoint none(VectorX(0));
  for (int k = 0; k < 4; ++k) CHECK(none.next(VectorX(0), VectorX(0)).size() == 0);
}
