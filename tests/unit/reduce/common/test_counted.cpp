// Tests of counts in messages: the singular is used for one only.
#include <cstddef>

#include <catch2/catch.hpp>

#include "reduce/common/counted.hpp"

namespace bielle {

TEST_CASE("one thing is counted in the singular, none and several in the plural", "[counted]") {
  CHECK(counted(1, "step") == "1 step");
  CHECK(counted(0, "step") == "0 steps");
  CHECK(counted(std::size_t{3}, "step") == "3 steps");
  CHECK(counted(-1L, "step") == "-1 steps");
}

TEST_CASE("irregular plurals are given", "[counted]") {
  CHECK(counted(1, "degree of freedom", "degrees of freedom") == "1 degree of freedom");
  CHECK(counted(6, "degree of freedom", "degrees of freedom") == "6 degrees of freedom");
  CHECK(counted(2, "frequency", "frequencies") == "2 frequencies");
}

}  // namespace bielle
