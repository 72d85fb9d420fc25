#include <catch2/catch.hpp>

#include "reduce/common/leading_component.hpp"

using namespace bielle;
using Eigen::VectorXd;

TEST_CASE("the leading component is the first of the largest ones, independently of rounding", "[common]") {
  VectorXd mode(6);
  mode << 0.1, -2, 0.5, 2, -2, 1;
  for (Eigen::Index k = 0; k < mode.size(); ++k) {
    VectorXd rounded = mode;
    rounded(k) *= 1 + 1e-9;
    CHECK(leading_component(rounded) < -1.9);
  }
  mode(1) *= 1 - 1e-3;
  CHECK(leading_component(mode) == 2);
  CHECK(leading_component(VectorXd()) == 0);
  CHECK(leading_component(VectorXd::Zero(3)) == 0);
  CHECK(leading_component(VectorXd::Constant(1, -3)) == -3);
}
