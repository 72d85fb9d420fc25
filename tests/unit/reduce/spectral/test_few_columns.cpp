#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "reduce/spectral/few_columns.hpp"
#include "reduce/spectral/symmetric_matrix.hpp"

using namespace bielle;
using Eigen::MatrixXd;

TEST_CASE("few columns: products of any shape, also with parts of larger arrays", "[spectral]") {
  for (const int rows : {0, 1, 7, 127, 128, 300})
    for (const int columns : {0, 1, 3, 4, 9, 40})
      for (const int vectors : {4, 8, 12, 16, 28}) {
        CAPTURE(rows, columns, vectors);
        const int row_stride = vectors + 4, stride = rows + 5;
        const MatrixXd a = MatrixXd::Random(stride, std::max(columns, 1));
        const RowMatrix x = RowMatrix::Random(columns + 1, row_stride), y = RowMatrix::Random(rows + 1, row_stride);
        const MatrixXd A = a.topLeftCorner(rows, columns);
        // Sums of so many products of numbers below one.
        const double rounding = 4e-16 * (rows + columns + 1);
        RowMatrix found = y, expected = y;
        subtract_product_with_few(rows, columns, a.data(), stride, x.data(), found.data(), vectors, row_stride);
        expected.topLeftCorner(rows, vectors) -= A * x.topLeftCorner(columns, vectors);
        CHECK((found - expected).cwiseAbs().maxCoeff() <= rounding);
        found = expected = x;
        subtract_transposed_product_with_few(rows, columns, a.data(), stride, y.data(), found.data(), vectors,
                                             row_stride);
        expected.topLeftCorner(columns, vectors) -= A.transpose() * y.topLeftCorner(rows, vectors);
        CHECK((found - expected).cwiseAbs().maxCoeff() <= rounding);
      }
}
