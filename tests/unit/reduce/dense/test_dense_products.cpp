// Compares products of dense matrices with those of Eigen, below and above the size from which BLAS is used.
#include <array>

#include <catch2/catch.hpp>

#include "reduce/dense/dense_products.hpp"

using namespace bielle;
using Eigen::MatrixXd;

namespace {

double error(const MatrixXd& A, const MatrixXd& B) { return (A - B).cwiseAbs().maxCoeff(); }

}  // namespace

TEST_CASE("products of dense matrices, of blocks, vectors and fixed sizes") {
  for (const Eigen::Index n : {1, 3, 20, 70})
    for (const Eigen::Index depth : {1, 6, 40})
      for (const Eigen::Index columns : {1, 2, 50}) {
        CAPTURE(n, depth, columns);
        const MatrixXd A = MatrixXd::Random(n + 4, depth + 3), B = MatrixXd::Random(depth + 1, columns + 2);
        const auto A_block = A.block(2, 1, n, depth);
        const auto B_block = B.block(1, 2, depth, columns);
        const MatrixXd C = MatrixXd::Random(n + 2, columns + 5), product = A_block * B_block;
        MatrixXd expected = C, result = C;
        expected.block(1, 3, n, columns) -= 0.5 * product;
        add_product(result.block(1, 3, n, columns), A_block, B_block, -0.5);
        CHECK(error(result, expected) < 1e-13);
        const MatrixXd transposed = A_block.transpose();
        result = C;
        add_transposed_product(result.block(1, 3, n, columns), transposed, B_block, -0.5);
        CHECK(error(result, expected) < 1e-13);
      }
  const Eigen::Matrix<double, 6, Eigen::Dynamic> V = MatrixXd::Random(6, 200);
  const Eigen::VectorXd x = Eigen::VectorXd::Random(200);
  Eigen::Matrix<double, 6, 6> square = Eigen::Matrix<double, 6, 6>::Zero();
  add_product(square, V, MatrixXd(V.transpose()));
  CHECK(error(square, V * V.transpose()) < 1e-12);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6);
  add_product(y, V, x);
  CHECK(error(y, V * x) < 1e-13);
  MatrixXd none(0, 5);
  add_product(none, MatrixXd(0, 3), MatrixXd(3, 5));
  add_transposed_product(square, MatrixXd(0, 6), MatrixXd(0, 6));
  CHECK(error(square, V * V.transpose()) < 1e-12);
}

TEST_CASE("congruent and weighted matrices") {
  const MatrixXd S = MatrixXd::Random(30, 30), P = MatrixXd::Random(30, 20), A = MatrixXd::Random(20, 20),
                 B = MatrixXd::Random(20, 20);
  MatrixXd X = congruent(S, P);
  CHECK(error(X, P.transpose() * S * P) < 1e-12);
  const MatrixXd expected = X + 2 * A - 3 * B;
  add_weighted(X, std::array{WeightedMatrix{&A, 2}, WeightedMatrix{&B, -3}});
  CHECK(error(X, expected) < 1e-13);
}
