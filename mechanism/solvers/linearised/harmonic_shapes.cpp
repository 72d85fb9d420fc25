#include "mechanism/solvers/linearised/harmonic_shapes.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

int HarmonicSizes::largest() const {
  constexpr double moves = 1e-9, equal = 1e-6;
  const VectorX& deciding = standing.sum() > moves * turning.sum() ? standing : turning;
  const Eigen::Index middle = deciding.size() / 2;
  Eigen::Index place = middle;
  const double most = deciding.maxCoeff(&place);
  if (!(most > 0)) return 1;  // nothing moves: no exponent is the principal one
  return deciding[middle] >= (1 - equal) * most ? 0 : static_cast<int>(place - middle);
}

VectorX HarmonicShapes::weights(double rate) const {
  const LinearisedEquations& e = equations_.first();
  return e.K.diagonal().cwiseAbs() + rate * rate * e.M.diagonal().cwiseAbs();
}

VectorX HarmonicShapes::weights(double rate, int h) const {
  return of_harmonics(weights(rate).replicate(1, 2 * h + 1), h);
}

VectorX HarmonicShapes::of_harmonics(const MatrixX& coefficients, int h) const {
  const auto n = static_cast<int>(coefficients.rows()), functions = 2 * h + 1;
  VectorX y = VectorX::Zero(functions * n);
  for (int p = 0; p < std::min(functions, static_cast<int>(coefficients.cols())); ++p)
    for (int i = 0; i < n; ++i) y[equations_.index(p, i, h)] = coefficients(i, p);
  return y;
}

HarmonicSizes HarmonicShapes::sizes(const Eigen::MatrixXcd& u, std::complex<double> s) const {
  const VectorX weight = weights(std::hypot(std::abs(s), equations_.rate()));
  HarmonicSizes sizes{VectorX::Zero(u.cols()), VectorX::Zero(u.cols())};
  for (Eigen::Index k = 0; k < u.cols(); ++k)
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      (turning_[static_cast<std::size_t>(i)] != 0 ? sizes.turning : sizes.standing)[k] +=
          weight[i] * std::norm(u(i, k));
  return sizes;
}

double HarmonicShapes::whirl(const HarmonicSizes& sizes) const {
  const Eigen::Index h = sizes.turning.size() / 2;
  const double whole = sizes.turning.sum();
  if (h == 0 || !(whole > 0)) return NAN;
  // A pattern that runs around forwards has a frequency less by the rate in axes that turn.
  const double less = sizes.turning[h - 1], more = sizes.turning[h + 1];
  constexpr double least = 0.1;
  if (!(less + more > least * whole)) return NAN;
  return std::copysign(1, equations_.rate()) * (less - more) / (less + more);
}

bool HarmonicShapes::is_shift(const Eigen::MatrixXcd& u, std::complex<double> s) const {
  if (!any_shift()) return false;
  constexpr double zero = 1e-5, same = 0.1;  // a copy lacks harmonics that are left out
  const double rate = equations_.rate(), k = std::round(s.imag() / rate);
  if (std::abs(s - std::complex<double>(0, k * rate)) > zero * std::abs(rate)) return false;
  const VectorX weight = weights(rate);
  const auto h = static_cast<int>(u.cols() / 2);
  const Eigen::MatrixXcd of_shift = equations_.amplitudes(shift(h), h);
  std::complex<double> product = 0;
  double size = 0, size_of_shift = 0;
  for (int column = 0; column < u.cols(); ++column) {
    const int from = column + static_cast<int>(k);
    if (from < 0 || from >= u.cols()) continue;
    for (Eigen::Index i = 0; i < u.rows(); ++i) {
      product += weight[i] * std::conj(of_shift(i, from)) * u(i, column);
      size += weight[i] * std::norm(u(i, column));
      size_of_shift += weight[i] * std::norm(of_shift(i, from));
    }
  }
  return std::norm(product) > (1 - same) * size * size_of_shift;
}

}  // namespace bielle::mechanism
