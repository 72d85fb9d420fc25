#include "mechanism/solvers/linearised/harmonic_shapes.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

namespace {

constexpr double copied = 0.9;  // less than 1 because copies lack the truncated harmonics

}  // namespace

int HarmonicSizes::largest() const {
  constexpr double moves = 1e-9, equal = 0.1;  // equal harmonics differ because others are truncated
  const VectorX& deciding = standing.sum() > moves * turning.sum() ? standing : turning;
  const Eigen::Index middle = deciding.size() / 2;
  Eigen::Index place = middle;
  const double most = deciding.maxCoeff(&place);
  if (!(most > 0)) return 1;  // without motion, no exponent is the principal one
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
  // In turning axes, the frequency of a forward pattern is lower by the rate.
  const double less = sizes.turning[h - 1], more = sizes.turning[h + 1];
  constexpr double least = 0.1;
  if (!(less + more > least * whole)) return NAN;
  return std::copysign(1, equations_.rate()) * (less - more) / (less + more);
}

bool HarmonicShapes::are_same(const Eigen::MatrixXcd& u, std::complex<double> s, const Eigen::MatrixXcd& other,
                              std::complex<double> of_other, double alike) const {
  constexpr double equal = 1e-5;
  const double rate = equations_.rate();
  const VectorX weight = weights(std::abs(rate));
  for (const bool conjugate : {false, true}) {
    const std::complex<double> t = conjugate ? std::conj(of_other) : of_other;
    const Eigen::MatrixXcd v = conjugate ? Eigen::MatrixXcd(other.rowwise().reverse().conjugate()) : other;
    const double k = std::round((s - t).imag() / rate);
    if (std::abs(s - t - std::complex<double>(0, k * rate)) > equal * std::max(std::abs(s), std::abs(rate))) continue;
    std::complex<double> product = 0;
    double size = 0, of_v = 0;
    for (Eigen::Index column = 0; column < u.cols(); ++column) {
      const double from = static_cast<double>(column) + k;
      if (from < 0 || from >= static_cast<double>(v.cols())) continue;
      const auto of_copy = static_cast<Eigen::Index>(from);
      for (Eigen::Index i = 0; i < u.rows(); ++i) {
        product += weight[i] * std::conj(v(i, of_copy)) * u(i, column);
        size += weight[i] * std::norm(u(i, column));
        of_v += weight[i] * std::norm(v(i, of_copy));
      }
    }
    const bool is_copy = k != 0 || (conjugate && of_other.imag() != 0);
    if (size > 0 && std::norm(product) > (is_copy ? copied : alike) * size * of_v) return true;
  }
  return false;
}

double HarmonicShapes::similarity(const Eigen::MatrixXcd& u, const Eigen::MatrixXcd& other) const {
  const Eigen::VectorXcd weight = weights(std::abs(equations_.rate())).cast<std::complex<double>>();
  const auto product = [&](const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
    return a.conjugate().cwiseProduct(weight.asDiagonal() * b).sum();
  };
  const double sizes = product(u, u).real() * product(other, other).real();
  return sizes > 0 ? std::norm(product(u, other)) / sizes : 0;
}

VectorX HarmonicShapes::similarities(const Eigen::MatrixXcd& u, const Eigen::MatrixXcd& other) const {
  const Eigen::VectorXcd weight = weights(std::abs(equations_.rate())).cast<std::complex<double>>();
  const Eigen::Index count = u.cols(), h = count / 2;
  const Eigen::MatrixXcd products = other.adjoint() * (weight.asDiagonal() * u);
  const auto square = [&](const Eigen::MatrixXcd& a) {
    return a.conjugate().cwiseProduct(weight.asDiagonal() * a).sum().real();
  };
  const double sizes = square(u) * square(other);
  VectorX result = VectorX::Zero(count);
  if (!(sizes > 0)) return result;
  for (Eigen::Index k = -h; k <= h; ++k) {
    std::complex<double> sum = 0;
    for (Eigen::Index from = std::max<Eigen::Index>(0, -k); from < count - std::max<Eigen::Index>(0, k); ++from)
      sum += products(from, from + k);
    result[h + k] = std::norm(sum) / sizes;
  }
  return result;
}

bool HarmonicShapes::is_shift(const Eigen::MatrixXcd& u, std::complex<double> s) const {
  if (!any_shift()) return false;
  const auto h = static_cast<int>(u.cols() / 2);
  return are_same(u, s, equations_.amplitudes(shift(h), h), 0, copied);
}

}  // namespace bielle::mechanism
