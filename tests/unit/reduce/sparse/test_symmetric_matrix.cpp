#include <array>
#include <random>

#include <catch2/catch.hpp>

#include "reduce/sparse/symmetric_matrix.hpp"

using namespace bielle;

namespace {

Eigen::MatrixXd random_sparse(int n) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < n; ++i) {
      if (i == j || random() % 4 == 0) {
        a(i, j) = a(j, i) = normal(random);
      }
    }
  }
  return a;
}

Eigen::MatrixXd dense(const SymmetricMatrix& a) { return a.multiply(RowMatrix::Identity(a.size, a.size)); }

}  // namespace

TEST_CASE(
    "Products of a sparse symmetric matrix with blocks equal those of the dense one, with any number of threads") {
  const Eigen::MatrixXd a = random_sparse(20);
  const SymmetricMatrix sparse = sparse_lower(a);
  for (int columns = 0; columns <= 26; ++columns) {
    const RowMatrix x = RowMatrix::Random(20, columns);
    // The products are sums of 20 products of numbers of order one.
    CHECK((sparse.multiply(x) - a * x).norm() < 1e-13);
    CHECK(sparse.multiply(x, 3) == sparse.multiply(x, 1));
  }
  CHECK(sparse.diagonal() == a.diagonal());
}

TEST_CASE("Products of complete and incomplete 3 x 3 blocks equal those of the dense matrix") {
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(24, 24);
  const Eigen::MatrixXd pattern = random_sparse(8), numbers = Eigen::MatrixXd::Random(24, 24);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      if (pattern(i, j) != 0) blocks.block<3, 3>(3 * i, 3 * j).setConstant(1);
  for (const auto& [row, column] : {std::pair{0, 0}, {1, 0}, {2, 1}, {22, 21}, {23, 20}, {23, 22}}) {
    Eigen::MatrixXd a = blocks.cwiseProduct(numbers + numbers.transpose());
    if (row != column) a(row, column) = a(column, row) = 0;
    for (const int columns : {4, 8, 12, 16, 20, 33}) {
      const RowMatrix x = RowMatrix::Random(24, columns);
      CHECK((sparse_lower(a).multiply(x, 2) - a * x).norm() < 1e-13);
      CHECK(sparse_lower(a).multiply(x, 3) == sparse_lower(a).multiply(x));
    }
  }
}

TEST_CASE("Submatrices of a sparse matrix, and dense borders, equal those of dense matrices") {
  const Eigen::MatrixXd a = random_sparse(9);
  const SymmetricMatrix sparse = sparse_lower(a);
  const std::array<std::int64_t, 4> kept{1, 2, 5, 8};
  CHECK(dense(principal_submatrix(sparse, kept)) == a(kept, kept));

  Eigen::MatrixXd all = random_sparse(12);
  all.topLeftCorner(9, 9) = a;
  CHECK(dense(bordered(sparse, all.topRightCorner(9, 3), all.bottomRightCorner(3, 3))) == all);
}
