// Shares in percent.
#include <catch2/catch.hpp>

#include "reduce/common/percent.hpp"

namespace bielle {

TEST_CASE("shares have two digits, and large ones all of their digits without an exponent", "[percent]") {
  CHECK(percent(0.000421) == "0.042 %");
  CHECK(percent(0.0314) == "3.1 %");
  CHECK(percent(0.1) == "10 %");
  CHECK(percent(0.994) == "99 %");
  CHECK(percent(0.996) == "100 %");
  CHECK(percent(1) == "100 %");
  CHECK(percent(-12.345) == "-1234 %");
  CHECK(percent(0) == "0 %");
}

}  // namespace bielle
