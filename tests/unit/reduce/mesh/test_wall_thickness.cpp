#include <catch2/catch.hpp>

#include "reduce/mesh/wall_thickness.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle;
using namespace bielle::reduce;

TEST_CASE(
    "Most of the surface of a plate with one element across its thickness is reported, but none of a plate with two",
    "[mesh]") {
  const bool quadratic = GENERATE(true, false);
  CHECK(share_one_element_thick(test::box_mesh({{6, 6, 1}, {6, 6, 1}, quadratic})) > 0.5);
  CHECK(share_one_element_thick(test::box_mesh({{6, 6, 1}, {6, 6, 2}, quadratic})) < 0.02);
  CHECK(share_one_element_thick(test::box_mesh({{1, 1, 1}, {4, 4, 4}, quadratic})) == 0);
}

TEST_CASE("A single flat cell is one element thick everywhere, for any areas of its sides") {
  // The three sides have different areas, and are inclined to the base by less than 30 degrees. The base is opposite to
  // each of them, and they are opposite to the base.
  Mesh mesh;
  mesh.points.resize(3, 4);
  mesh.points << 0, 1, 0, 0.4,  //
      0, 0, 1, 0.4,             //
      0, 0, 0, 0.05;
  mesh.blocks.push_back({CellType::tet4, Eigen::Vector4i(0, 1, 2, 3)});
  CHECK(share_one_element_thick(mesh) == Approx(1).epsilon(1e-14));
}
