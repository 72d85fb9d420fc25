#include "mechanism/solvers/linearised/equation_products.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using VectorXc = Eigen::VectorXcd;

/// Returns b without its holonomic rows, or without the others.
VectorXc rows_of(const LinearisedEquations& e, VectorXc b, bool nonholonomic) {
  for (int k = 0; k < e.constraints(); ++k)
    if ((e.nonholonomic[static_cast<std::size_t>(k)] != 0) != nonholonomic) b[k] = 0;
  return b;
}

}  // namespace

VectorXc equations_times(const LinearisedEquations& e, Complex s, const VectorXc& q) {
  const int n = e.unknowns();
  const VectorXc u = q.head(n), lambda = q.tail(e.constraints());
  const VectorXc rate = s * u + e.W.cast<Complex>() * u;
  VectorXc product(q.size());
  product.head(n) = s * (e.M.cast<Complex>() * rate) + e.C.cast<Complex>() * rate + e.K.cast<Complex>() * u;
  product.head(n) += e.B.transpose().cast<Complex>() * lambda + e.F.cast<Complex>() * lambda;
  product.tail(e.constraints()) = rows_of(e, e.B.cast<Complex>() * u, false) +
                                  rows_of(e, VectorXc(e.B.cast<Complex>() * rate + e.S.cast<Complex>() * u), true);
  return product;
}

VectorXc transposed_equations_times(const LinearisedEquations& e, Complex s, const VectorXc& q) {
  const int n = e.unknowns();
  const VectorXc a = q.head(n), held = rows_of(e, q.tail(e.constraints()), false),
                 rolling = rows_of(e, q.tail(e.constraints()), true);
  VectorXc of_rates = s * (e.M.transpose().cast<Complex>() * a) + e.C.transpose().cast<Complex>() * a;
  of_rates += e.B.transpose().cast<Complex>() * rolling;
  VectorXc product(q.size());
  product.head(n) = s * of_rates + e.W.transpose().cast<Complex>() * of_rates + e.K.transpose().cast<Complex>() * a;
  product.head(n) += e.B.transpose().cast<Complex>() * held + e.S.transpose().cast<Complex>() * rolling;
  product.tail(e.constraints()) = e.B.cast<Complex>() * a + e.F.transpose().cast<Complex>() * a;
  return product;
}

VectorXc equations_derivative_times(const LinearisedEquations& e, Complex s, const VectorXc& q) {
  const int n = e.unknowns();
  const VectorXc u = q.head(n), turned = e.W.cast<Complex>() * u;
  VectorXc product(q.size());
  product.head(n) = e.M.cast<Complex>() * VectorXc(2.0 * s * u + turned) + e.C.cast<Complex>() * u;
  product.tail(e.constraints()) = rows_of(e, e.B.cast<Complex>() * u, true);
  return product;
}

VectorX resistance_times(const LinearisedEquations& e, double sigma, const VectorX& u) {
  const int n = e.unknowns();
  VectorX result = VectorX::Zero(n + e.constraints());
  result.head(n) = sigma * (e.C * u + e.M * VectorX(sigma * u + e.W * u));
  const VectorX rolling = sigma * (e.B * u);
  for (int k = 0; k < e.constraints(); ++k)
    if (e.nonholonomic[static_cast<std::size_t>(k)]) result[n + k] = rolling[k];
  return result;
}

}  // namespace bielle::mechanism
