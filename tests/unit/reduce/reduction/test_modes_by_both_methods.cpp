// Compares the block method with ARPACK on solids with multiple frequencies, held and free.
#include <catch2/catch.hpp>

#include "tests/support/box_mesh.hpp"
#include "tests/support/solid_model.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

void compare(const test::SolidModel& model, int count) {
  EigenpairOptions arpack;
  arpack.method = EigenMethod::arpack;
  const Eigen::VectorXd expected = model.frequencies(count, arpack);
  for (const int block : {1, 2, 5, 12}) {
    CAPTURE(block);
    EigenpairOptions options;
    options.method = EigenMethod::block_lanczos;
    options.block = block;
    const Eigen::VectorXd found = model.frequencies(count, options);
    REQUIRE(found.size() == count);
    // Eigenvalues have errors of the squares of residuals, and of eps |K| / lambda, which is 1e-11 here.
    CHECK((found.array() / expected.array() - 1).abs().maxCoeff() < 1e-10);
  }
}

}  // namespace

TEST_CASE("block Lanczos: a free cube has the frequencies that ARPACK finds, including pairs", "[reduction]") {
  const test::SolidModel cube(test::box_mesh({{1, 1, 1}, {4, 4, 4}}), test::steel());
  const Eigen::VectorXd frequencies = cube.frequencies(30);
  int pairs = 0;
  for (Eigen::Index k = 1; k < 30; ++k) pairs += frequencies(k) / frequencies(k - 1) - 1 < 1e-9;
  CHECK(pairs > 3);
  compare(cube, 30);
}

TEST_CASE("block Lanczos: a square bar held at one end has pairs of bending frequencies", "[reduction]") {
  const test::SolidModel bar(test::box_mesh({{4, 0.2, 0.2}, {20, 2, 2}}), test::steel(),
                             [](const Eigen::Vector3d& x, int) { return x.x() < 1e-9; });
  compare(bar, 25);
}
