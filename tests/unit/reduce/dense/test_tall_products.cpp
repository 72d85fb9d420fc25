#include <catch2/catch.hpp>

#include "reduce/dense/tall_products.hpp"

using namespace bielle;
using Eigen::MatrixXd;

TEST_CASE("tall products equal those of Eigen, for any number of threads and rows", "[spectral]") {
  for (const int rows : {1, 7, 513, 9001}) {
    for (const int threads : {1, 2, 3}) {
      CAPTURE(rows, threads);
      const MatrixXd A = MatrixXd::Random(rows, 13), B = MatrixXd::Random(rows, 5), C = MatrixXd::Random(13, 5);
      CHECK(tall_inner_products(A, B, threads).isApprox(A.transpose() * B, 1e-13));
      MatrixXd Y = B;
      add_tall_product(Y, A, C, -2, threads);
      CHECK(Y.isApprox(B - 2 * A * C, 1e-13));
      MatrixXd Q = A;
      combine_columns(Q, C, threads);
      CHECK(Q.leftCols(5).isApprox(A * C, 1e-13));
      CHECK(Q.rightCols(8) == A.rightCols(8));
      const MatrixXd many = MatrixXd::Random(rows, 40), weights = MatrixXd::Random(13, 40);  // more than registers hold
      CHECK(tall_inner_products(A, many, threads).isApprox(A.transpose() * many, 1e-13));
      Y = many;
      add_tall_product(Y, A, weights, 1, threads);
      CHECK(Y.isApprox(many + A * weights, 1e-13));
    }
  }
}

TEST_CASE("tall products of empty matrices", "[spectral]") {
  MatrixXd A(100, 0), Y = MatrixXd::Ones(100, 2);
  CHECK(tall_inner_products(A, Y, 2).size() == 0);
  add_tall_product(Y, A, MatrixXd(0, 2), 1, 2);
  CHECK(Y == MatrixXd::Ones(100, 2));
}
