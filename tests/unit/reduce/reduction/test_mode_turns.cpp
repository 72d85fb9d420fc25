#include <catch2/catch.hpp>

#include "reduce/reduction/mode_turns.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;

TEST_CASE("Turns of modes are those of the displacement field at places from end to end") {
  const Mesh mesh = test::box_mesh({{1, 0.1, 0.1}, {20, 2, 2}});
  const ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 0);
  const Solid solid = make_solid(mesh, options.materials, options.regions);
  const Eigen::Vector3d turn(0.2, -0.5, 0.3);
  RowMatrix fields(3 * solid.points(), 2);
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    const Eigen::Vector3d X = mesh.points.col(a);
    fields.block<3, 1>(3 * a, 0) = turn.cross(X);
    fields.block<3, 1>(3 * a, 1) = Eigen::Vector3d(-X.x() * X.z(), 0, X.x() * X.x() / 2);  // bent: turned by -x about y
  }
  const Eigen::MatrixXd turns = mode_turns(solid, fields, 0, "bar");
  REQUIRE(turns.rows() % 3 == 0);
  REQUIRE(turns.rows() >= 3 * 8);
  REQUIRE(turns.cols() == 2);
  double least = 0, most = -1;
  for (Eigen::Index k = 0; k < turns.rows(); k += 3) {
    CHECK((turns.block<3, 1>(k, 0) - turn).norm() < 1e-10);
    CHECK(std::abs(turns(k, 1)) + std::abs(turns(k + 2, 1)) < 0.05);
    least = std::min(least, turns(k + 1, 1));
    most = std::max(most, turns(k + 1, 1));
  }
  CHECK(most - least == Approx(1).epsilon(0.1));  // elements of 0.05 m
}
