#include "reduce/reduction/inertia_answer.hpp"

#include "reduce/dense/dense_products.hpp"
#include "reduce/reduction/reduced_matrices.hpp"

namespace bielle::reduce {

InertiaAnswer inertia_answer_energies(const Basis& basis) {
  const Eigen::MatrixXd whole = inner_products(basis.linear.inertia, basis.linear.held);
  InertiaAnswer answer;
  answer.whole = (whole + whole.transpose()) / 2;
  answer.missing = answer.whole;
  if (basis.modes() == 0) return answer;
  const RowMatrix modes = basis.shapes.rightCols(basis.modes());
  const Eigen::MatrixXd participation =
      basis.eigenvalues.cwiseSqrt().cwiseInverse().asDiagonal() * inner_products(modes, basis.linear.inertia);
  answer.missing -= transposed_product(participation, participation);
  answer.missing = Eigen::MatrixXd(answer.missing + answer.missing.transpose()) / 2;
  return answer;
}

ResidualRequest inertia_relief(const LinearFields& linear) {
  ResidualRequest request{"inertia_relief", SparseRows(linear.inertia.rows(), LinearFields::count)};
  request.may_be_empty = true;
  request.loads.reserve(Eigen::VectorXi::Constant(linear.inertia.rows(), 4));
  for (Eigen::Index row = 0; row < linear.inertia.rows(); ++row)
    for (Eigen::Index column = 0; column < LinearFields::count; ++column)  // masses alone couple directions
      if (column / 4 == row % 3 || linear.inertia(row, column) != 0)
        request.loads.insert(row, column) = linear.inertia(row, column);
  request.loads.makeCompressed();
  return request;
}

}  // namespace bielle::reduce
