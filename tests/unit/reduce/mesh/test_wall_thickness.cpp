#include <catch2/catch.hpp>

#include "reduce/mesh/wall_thickness.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle;
using namespace bielle::reduce;

TEST_CASE("A plate one element thick is so below most of its surface, one of two elements nowhere", "[mesh]") {
  const bool quadratic = GENERATE(true, false);
  CHECK(share_one_element_thick(test::box_mesh({{6, 6, 1}, {6, 6, 1}, quadratic})) > 0.5);
  CHECK(share_one_element_thick(test::box_mesh({{6, 6, 1}, {6, 6, 2}, quadratic})) < 0.02);
  CHECK(share_one_element_thick(test::box_mesh({{1, 1, 1}, {4, 4, 4}, quadratic})) == 0);
}
