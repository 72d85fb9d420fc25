#include <catch2/catch.hpp>

#include "reduce/spectral/krylov_basis.hpp"
#include "tests/unit/reduce/spectral/dense_pencil.hpp"

using namespace bielle;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

test::DensePencil pencil() {
  return {test::chain_of_springs(VectorXd::LinSpaced(201, 1, 4)), VectorXd::LinSpaced(200, 1, 2).asDiagonal()};
}

struct Checked {
  VectorXd residuals;        // |S M x - nu x|_M
  double orthogonality = 0;  // largest entry of X^T M X - I
};

/// Returns the properties of the Ritz vectors of a basis, which is consumed.
Checked check_ritz_vectors(const test::DensePencil& of, KrylovBasis& basis) {
  const RitzPairs ritz = basis.ritz();
  const Index old = basis.locked();
  MatrixXd weights = MatrixXd::Zero(basis.size(), old + ritz.size());
  weights.topLeftCorner(old, old).setIdentity();
  weights.bottomRightCorner(ritz.size(), ritz.size()) = ritz.weights;
  VectorXd values(old + ritz.size());
  values << basis.locked_values(), ritz.values;
  basis.lock(weights, values);
  const MatrixXd X = basis.take_locked_vectors();
  const MatrixXd error = of.factor.solve(of.M * X) - X * values.asDiagonal();
  return {error.cwiseProduct(of.M * error).colwise().sum().cwiseSqrt().transpose(),
          (X.transpose() * of.M * X - MatrixXd::Identity(X.cols(), X.cols())).cwiseAbs().maxCoeff()};
}

}  // namespace

TEST_CASE("Krylov basis: the recurrence gives the residuals of Ritz vectors, after restarts as well", "[spectral]") {
  const test::DensePencil chain = pencil();
  const ShiftInvertProblem problem = chain.problem();
  const double largest = 1 / chain.values()(0);
  for (const int restarts : {0, 1, 3}) {
    CAPTURE(restarts);
    Index columns = 0;
    KrylovBasis basis(problem, 40, 1, [&](Index more) { columns += more; });
    basis.start(5);
    CHECK(basis.front() == 5);
    for (int k = 0; k < 4; ++k) basis.expand();
    for (int k = 0; k < restarts; ++k) {
      basis.restart(basis.ritz(), 9);
      CHECK(basis.size() == 9);
      CHECK(basis.front() == 5);
      for (int j = 0; j < 3; ++j) basis.expand();
    }
    CHECK(basis.room() == 40 - basis.size() - 5);
    CHECK(columns == 5 * (1 + 4 + 3 * restarts));
    const RitzPairs ritz = basis.ritz();
    CHECK(std::abs(ritz.values(0)) == Approx(largest).epsilon(1e-6));
    const Checked checked = check_ritz_vectors(chain, basis);
    CHECK((checked.residuals - ritz.residuals).cwiseAbs().maxCoeff() < 1e-13 * largest);
    CHECK(checked.orthogonality <
          1e-11);  // blocks with a condition number of up to 100 are orthonormal up to eps times its square
  }
}

TEST_CASE("Krylov basis: a new front orthogonal to the locked vectors finds the remaining eigenpairs", "[spectral]") {
  const test::DensePencil chain = pencil();
  const ShiftInvertProblem problem = chain.problem();
  KrylovBasis basis(problem, 120, 1, [](Index) {});
  basis.start(4);
  for (int k = 0; k < 20; ++k) basis.expand();
  const RitzPairs ritz = basis.ritz();
  REQUIRE(ritz.residuals(2) < 1e-12 * ritz.values(2));
  basis.lock(ritz.weights.leftCols(3), ritz.values.head(3));
  CHECK(basis.front() == 0);
  basis.start(4);
  for (int k = 0; k < 16; ++k) basis.expand();
  CHECK(1 / basis.ritz().values(0) == Approx(chain.values()(3)).epsilon(1e-11));
  CHECK(check_ritz_vectors(chain, basis).orthogonality < 1e-12);
}

TEST_CASE("Krylov basis: the front becomes narrower as directions are exhausted, and finally empty", "[spectral]") {
  VectorXd values(7);
  values << 1, 1, 1, 1, 2, 2, 3;
  const test::DensePencil few{test::with_eigenvalues(values), MatrixXd::Identity(7, 7)};
  const ShiftInvertProblem problem = few.problem();
  KrylovBasis basis(problem, 12, 1, [](Index) {});
  basis.start(3);
  basis.expand();
  CHECK(basis.front() == 3);  // three directions of eigenvalue 1, two of 2, one of 3: six in all
  basis.expand();
  CHECK(basis.size() == 6);
  CHECK(basis.front() == 0);
  basis.start(3);
  CHECK(basis.front() == 1);
  basis.expand();
  CHECK(basis.size() == 7);
  CHECK(basis.front() == 0);
  basis.start(3);
  CHECK(basis.front() == 0);
  CHECK(check_ritz_vectors(few, basis).orthogonality < 1e-13);
}
