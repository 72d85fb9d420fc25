#include <algorithm>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "reduce/spectral/few_vectors.hpp"
#include "reduce/spectral/symmetric_matrix.hpp"

using namespace bielle;
using Eigen::MatrixXd;

namespace {

/// Of sums of so many products of numbers below one.
double rounding_of(Eigen::Index terms) { return 4e-16 * static_cast<double>(terms + 1); }

/// All but some vectors in the middle of each row must stay as they are.
const std::vector<Vectors> parts_of_rows{{0, 8, 8}, {0, 16, 16}, {8, 16, 32}, {8, 24, 40}, {0, 40, 41}};

auto part(RowMatrix& x, const Vectors& vectors, Eigen::Index first, Eigen::Index rows) {
  return x.block(first, vectors.first, rows, vectors.count);
}

}  // namespace

TEST_CASE("few vectors: products with panels of any shape, on every kind of processor that is here", "[spectral]") {
  for (const FewVectors* kernels : FewVectors::all())
    for (const Vectors& vectors : parts_of_rows)
      for (int rows = 1; rows <= lines_abreast; ++rows)
        for (const int columns : {0, 1, 5, 70}) {
          CAPTURE(rows, columns, vectors.first, vectors.count);
          const MatrixXd A = MatrixXd::Random(rows, columns);
          const FactorPanel panel{rows, columns, A.data()};
          const RowMatrix x = RowMatrix::Random(columns, vectors.stride),
                          y = RowMatrix::Random(2 * rows, vectors.stride);
          RowMatrix found = y, expected = y;
          std::vector<double*> addresses;
          for (int i = 0; i < rows; ++i) addresses.push_back(found.row((i * 2 + 5) % (2 * rows)).data());
          for (int i = 0; i < rows; ++i)
            part(expected, vectors, (i * 2 + 5) % (2 * rows), 1) -=
                A.row(i) * x.middleCols(vectors.first, vectors.count);
          kernels->subtract_product(panel, x.data(), addresses.data(), vectors);
          CHECK((found - expected).cwiseAbs().maxCoeff() <= rounding_of(columns));
          RowMatrix found_x = x, expected_x = x;
          for (int i = 0; i < rows; ++i)
            part(expected_x, vectors, 0, columns) -=
                A.row(i).transpose() * part(found, vectors, (i * 2 + 5) % (2 * rows), 1);
          kernels->subtract_transposed_product(panel, addresses.data(), found_x.data(), vectors);
          CHECK((found_x - expected_x).cwiseAbs().sum() <= rounding_of(rows) * static_cast<double>(x.size()) + 1e-30);
        }
}

TEST_CASE("few vectors: substitution is the solution of the triangle", "[spectral]") {
  for (const FewVectors* kernels : FewVectors::all())
    for (const Vectors& vectors : parts_of_rows)
      for (int rows = 1; rows <= lines_abreast; ++rows)
        for (const int columns : {0, 3, 50}) {
          CAPTURE(rows, columns, vectors.first, vectors.count);
          MatrixXd L = MatrixXd::Random(rows, columns + rows);
          MatrixXd T = L.rightCols(rows).triangularView<Eigen::StrictlyLower>();
          for (int k = 0; k < rows; ++k) {
            T(k, k) = 2 + L(k, columns + k);
            L(k, columns + k) = 1 / T(k, k);
          }
          const FactorPanel panel{rows, columns, L.data()};
          const RowMatrix x = RowMatrix::Random(columns + rows, vectors.stride);
          RowMatrix found = x, expected = x;
          kernels->substitute_forwards(panel, found.data(), vectors);
          auto own = part(expected, vectors, columns, rows);
          own = RowMatrix(T.triangularView<Eigen::Lower>().solve(
              RowMatrix(own - L.leftCols(columns) * part(expected, vectors, 0, columns))));
          CHECK((found - expected).norm() <= 1e-13 * expected.norm());
          found = expected = x;
          kernels->substitute_backwards(panel, found.data(), vectors);
          own = RowMatrix(T.triangularView<Eigen::Lower>().transpose().solve(RowMatrix(own)));
          part(expected, vectors, 0, columns) -= L.leftCols(columns).transpose() * own;
          CHECK((found - expected).norm() <= 1e-13 * expected.norm());
        }
}

TEST_CASE("few vectors: products with tall matrices", "[spectral]") {
  for (const FewVectors* kernels : FewVectors::all())
    for (const Vectors& vectors : parts_of_rows)
      for (int columns = 1; columns <= lines_abreast; ++columns)
        for (const int rows : {0, 1, 200}) {
          CAPTURE(rows, columns, vectors.first, vectors.count);
          const MatrixXd array = MatrixXd::Random(rows + 3, columns), A = array.topRows(rows);
          const TallColumns tall{rows, columns, array.data(), array.rows()};
          const RowMatrix y = RowMatrix::Random(rows, vectors.stride), x = RowMatrix::Random(columns, vectors.stride);
          RowMatrix found = x, expected = x;
          part(expected, vectors, 0, columns) += A.transpose() * y.middleCols(vectors.first, vectors.count);
          kernels->add_inner_products(tall, y.data(), found.data(), vectors);
          CHECK((found - expected).cwiseAbs().maxCoeff() <= rounding_of(rows));
          RowMatrix found_y = y, expected_y = y;
          part(expected_y, vectors, 0, rows) += A * x.middleCols(vectors.first, vectors.count);
          kernels->add_product(tall, x.data(), found_y.data(), vectors);
          CHECK((found_y - expected_y).cwiseAbs().sum() <= rounding_of(columns) * static_cast<double>(y.size() + 1));
        }
}
