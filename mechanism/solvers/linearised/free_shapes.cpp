#include "mechanism/solvers/linearised/free_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/linearised/equation_products.hpp"
#include "mechanism/solvers/linearised/orthonormal.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the zeros' vectors, scaled; dependent ones are separated.
MatrixX start_shapes(const VectorX& scale, const std::vector<Eigenpair>& zeros) {
  const Eigen::Index n = scale.size(), count = std::min<Eigen::Index>(n, static_cast<Eigen::Index>(zeros.size()));
  MatrixX shapes(n, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const VectorX u = zeros[static_cast<std::size_t>(k)].x.head(n).real();
    shapes.col(k) = u.cwiseQuotient(scale).normalized();
    for (Eigen::Index i = 0; i < n; ++i)
      shapes(i, k) +=
          0.3 / std::sqrt(static_cast<double>(n)) * std::cos(static_cast<double>((i + 1) * (2 * k + 1) % 7919));
  }
  return shapes;
}

}  // namespace

MatrixX find_free_shapes(const LinearisedEquations& e, const ShiftedOperator& shifted,
                         const std::vector<Eigenpair>& zeros) {
  const int n = e.unknowns();
  const VectorX scale = shifted.scale().head(n);
  const double shift = shifted.shift().real();
  MatrixX shapes = start_shapes(scale, zeros);
  if (shapes.cols() == 0) return shapes;
  const auto answer = [&](const VectorX& x) {
    const VectorX u = scale.cwiseProduct(x);
    const VectorX right = resistance_times(e, shift, u);
    return VectorX(shifted.solve(right.cast<std::complex<double>>()).head(n).real().cwiseQuotient(scale));
  };
  // With this size of the shift, each round halves the parts of other shapes.
  constexpr int rounds = 100, separated = 60;
  constexpr double stays = 1e-8, settled = 1e-22, leaves = 1e-3;  // squares of changes
  SymmetricEigenpairs change;
  for (int round = 0; round < rounds; ++round) {
    shapes = orthonormal_columns(shapes);
    MatrixX answers(n, shapes.cols());
    for (Eigen::Index k = 0; k < shapes.cols(); ++k) answers.col(k) = answer(shapes.col(k));
    const MatrixX changes = answers - shapes;
    change = symmetric_eigenpairs(MatrixX(changes.transpose() * changes));
    if (round > separated && std::all_of(change.values.begin(), change.values.end(),
                                         [](double value) { return value < settled || value > leaves; }))
      break;
    if (round + 1 < rounds) shapes = answers;
  }
  Eigen::Index count = 0;
  while (count < change.values.size() && change.values[count] < stays) ++count;
  return scale.asDiagonal() * (shapes * change.vectors.leftCols(count));
}

}  // namespace bielle::mechanism
