#include "mechanism/elements/control/linear_block.hpp"

#include <cmath>

#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the mean frequency of the nonzero poles [rad/s]; 1 if all poles are zero. @param a  in ascending powers of s
double mean_frequency(const std::vector<double>& a) {
  const std::size_t n = a.size() - 1;
  std::size_t lowest = 0;
  while (a[lowest] == 0) ++lowest;
  return lowest == n ? 1 : std::pow(std::abs(a[lowest] / a[n]), 1 / static_cast<double>(n - lowest));
}

}  // namespace

LinearBlock integrator() {
  return {MatrixX::Zero(1, 1), MatrixX::Ones(1, 1), MatrixX::Ones(1, 1), MatrixX::Zero(1, 1)};
}

LinearBlock first_order_filter(double time_constant) {
  LinearBlock block = integrator();
  block.A(0, 0) = -1 / time_constant;
  block.B(0, 0) = 1 / time_constant;
  return block;
}

LinearBlock no_filter() {
  LinearBlock block = first_order_filter(1);
  block.C(0, 0) = 0;
  block.D(0, 0) = 1;
  return block;
}

LinearBlock second_order_filter(double frequency, double damping) {
  const double w = 2 * M_PI * frequency;
  LinearBlock block{MatrixX(2, 2), MatrixX(2, 1), MatrixX(2, 2), MatrixX::Zero(2, 1)};
  block.A << 0, w, -w, -2 * damping * w;
  block.B << 0, w;
  block.C << 1, 0, 0, w;
  return block;
}

LinearBlock realisation(const std::vector<double>& numerator, const std::vector<double>& denominator) {
  const std::size_t n = denominator.size() - 1;
  const std::vector<double> a(denominator.rbegin(), denominator.rend());
  std::vector<double> b(numerator.rbegin(), numerator.rend());
  b.resize(n + 1, 0.0);
  const double d = b[n] / a[n], w = mean_frequency(a), whole = a[n] * std::pow(w, static_cast<double>(n));
  const auto size = static_cast<Eigen::Index>(n);
  LinearBlock block{MatrixX::Zero(size, size), MatrixX::Zero(size, 1), MatrixX::Zero(1, size),
                    MatrixX::Constant(1, 1, d)};
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double power = std::pow(w, static_cast<double>(k));
    if (i + 1 < size) block.A(i, i + 1) = w;
    block.C(0, i) = (b[k] - d * a[k]) * power / whole;
    block.A(size - 1, i) -= w * (a[k] * power / whole);
  }
  block.B(size - 1, 0) = w;
  return block;
}

std::optional<MatrixX> rest_of(const LinearBlock& block) {
  const auto inverse = regular_inverse(block.A);
  if (!inverse) return std::nullopt;
  return MatrixX(-*inverse * block.B);
}

}  // namespace bielle::mechanism
