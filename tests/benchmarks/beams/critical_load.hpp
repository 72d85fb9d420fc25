// Checks critical loads of beams against their references.
#pragma once

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

namespace bielle::test {

/// Loads for three meshes approach the reference with the square of the element length.
template <class Load>
void check_load(double exact, const Load& load) {
  std::vector<double> errors;
  for (int elements : {4, 8, 16}) errors.push_back(load(elements) / exact - 1);
  CAPTURE(exact, errors);
  CHECK_THAT(std::log2(errors[0] / errors[1]), Catch::WithinAbs(2, 0.2));
  CHECK_THAT(std::log2(errors[1] / errors[2]), Catch::WithinAbs(2, 0.1));
  CHECK(std::abs(errors[2]) < 5e-3);
  CHECK(std::abs(4 * errors[2] - errors[1]) / 3 < 1e-4);
}

}  // namespace bielle::test
