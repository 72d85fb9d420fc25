#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/fe/mean_strain.hpp"
#include "reduce/reduction/mode_turns.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;

TEST_CASE("The rotations of modes are those of the displacement field, at places from end to end") {
  const Mesh mesh = test::box_mesh({{1, 0.1, 0.1}, {20, 2, 2}});
  const ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 0);
  const Solid solid = make_solid(mesh, options.materials, options.regions);
  const Eigen::Vector3d turn(0.2, -0.5, 0.3);
  RowMatrix fields(3 * solid.points(), 2);
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    const Eigen::Vector3d X = mesh.points.col(a);
    fields.block<3, 1>(3 * a, 0) = turn.cross(X);
    // The second field is bending with the rotation -x about y.
    fields.block<3, 1>(3 * a, 1) = Eigen::Vector3d(-X.x() * X.z(), 0, X.x() * X.x() / 2);
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
  CHECK(most - least == Approx(1).epsilon(0.1));  // the elements are 0.05 m long
  // Each place is as far as possible from the previous ones; the radius of coverage is at most twice the best one (T.
  // F. Gonzalez, Theor. Comput. Sci. 38 (1985) 293). 24 places along the axis cover the bar with a radius of 0.074 m.
  std::vector<double> along;
  for (Eigen::Index k = 0; k < turns.rows(); k += 3) along.push_back(-turns(k + 1, 1));
  std::sort(along.begin(), along.end());
  double gap = 0;
  for (std::size_t k = 1; k < along.size(); ++k) gap = std::max(gap, along[k] - along[k - 1]);
  CHECK(gap < 4 * 0.074 + 0.05);
}

TEST_CASE("Strains at places are those of the displacement field, and the last one is the mean over the body") {
  for (const bool quadratic : {true, false}) {
    const Mesh mesh = test::box_mesh({{1, 0.1, 0.1}, {20, 2, 2}, quadratic});
    const ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 0);
    const Solid solid = make_solid(mesh, options.materials, options.regions);
    Eigen::Matrix3d gradient;
    gradient << 0.1, 0.2, -0.3, 0.05, -0.4, 0.7, 0.6, 0.15, 0.25;
    Eigen::Matrix<double, 6, 1> strain;
    strain << 0.1, -0.4, 0.25, 0.7 + 0.15, -0.3 + 0.6, 0.2 + 0.05;
    RowMatrix fields(3 * solid.points(), 3);
    for (Eigen::Index a = 0; a < solid.points(); ++a) {
      const Eigen::Vector3d X = mesh.points.col(a);
      fields.block<3, 1>(3 * a, 0) = gradient * X;
      fields.block<3, 1>(3 * a, 1) = Eigen::Vector3d(0.3, -0.5, 0.2).cross(X);
      const double z = X.z() - 0.05;  // distance from the axis
      fields.block<3, 1>(3 * a, 2) = Eigen::Vector3d(-X.x() * z, 0, X.x() * X.x() / 2);
    }
    const Eigen::MatrixXd strains = place_strains(solid, fields, "bar");
    REQUIRE(strains.rows() >= 6 * 9);
    double largest = 0;
    for (Eigen::Index k = 0; k < strains.rows(); k += 6) {
      CHECK((strains.block<6, 1>(k, 0) - strain).norm() < 1e-10);
      CHECK(strains.block<6, 1>(k, 1).norm() < 1e-10);
      largest = std::max(largest, std::abs(strains(k, 2)));
    }
    CHECK(largest > (quadratic ? 0.035 : 0.02));  // strain of the outermost fibres, reduced by about half an element
    CHECK(largest < 0.05 * (1 + 1e-9));
    if (quadratic) CHECK(std::abs(strains(strains.rows() - 6, 2)) < 1e-12);  // the mean strain of bending is zero
  }
}

TEST_CASE("The mean strain of a body with curved cells is exact for linear fields") {
  const Mesh mesh = test::twisted_block();
  const Solid solid = make_solid(mesh, {{"steel", test::steel()}}, {{"all", "steel"}});
  RowMatrix fields = RowMatrix::Zero(3 * solid.points(), 2);
  for (Eigen::Index a = 0; a < solid.points(); ++a) {
    fields(3 * a, 0) = mesh.points(0, a);
    fields(3 * a + 1, 1) = mesh.points(2, a);
  }
  const Eigen::MatrixXd mean = mean_strain(solid, fields);
  CHECK((mean.col(0) - Eigen::VectorXd::Unit(6, 0)).norm() < 1e-12);
  CHECK((mean.col(1) - Eigen::VectorXd::Unit(6, 3)).norm() < 1e-12);
}
