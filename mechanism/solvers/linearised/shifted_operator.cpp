#include "mechanism/solvers/linearised/shifted_operator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace bielle::mechanism {
namespace {

using Complex = ShiftedOperator::Complex;
using SparseC = Eigen::SparseMatrix<Complex>;
using VectorXc = ShiftedOperator::VectorXc;

}  // namespace

ShiftedOperator::ShiftedOperator(const LinearisedEquations& equations, Complex shift, Side side)
    : equations_(equations), shift_(shift), side_(side) {
  build(nullptr);
}

ShiftedOperator::ShiftedOperator(const LinearisedEquations& equations, Complex shift,
                                 std::unique_ptr<ShiftedOperator> other)
    : equations_(equations), shift_(shift), side_(Side::right) {
  build(other.get());
}

ShiftedOperator::~ShiftedOperator() = default;

void ShiftedOperator::build(ShiftedOperator* other) {
  const LinearisedEquations& e = equations_;
  const int n = e.unknowns(), m = e.constraints(), size = n + m;
  SparseC shifted(n, n);
  shifted.setIdentity();
  shifted = SparseC(shifted * shift_ + e.W.cast<Complex>());
  rates_ = SparseC(e.M.cast<Complex>() * shift_ + e.C.cast<Complex>());
  if (is_real()) real_rates_ = rates_.real();
  any_nonholonomic_ = std::any_of(e.nonholonomic.begin(), e.nonholonomic.end(), [](char each) { return each != 0; });
  const SparseC D = SparseC(rates_ * shifted) + e.K.cast<Complex>();
  const SparseC moving = SparseC(e.B.cast<Complex>() * shifted) + e.S.cast<Complex>();

  std::vector<Eigen::Triplet<Complex>> entries;
  const auto add = [&](int row, int column, Complex value) {
    if (side_ == Side::left) std::swap(row, column);
    entries.emplace_back(row, column, value);
  };
  for (int j = 0; j < n; ++j) {
    for (SparseC::InnerIterator it(D, j); it; ++it) add(static_cast<int>(it.row()), j, it.value());
    for (LinearisedEquations::Sparse::InnerIterator it(e.B, j); it; ++it) {
      const int row = static_cast<int>(it.row());
      add(j, n + row, it.value());
      if (!e.nonholonomic[static_cast<std::size_t>(row)]) add(n + row, j, it.value());
    }
    for (SparseC::InnerIterator it(moving, j); it; ++it)
      if (e.nonholonomic[static_cast<std::size_t>(it.row())]) add(n + static_cast<int>(it.row()), j, it.value());
  }
  for (int j = 0; j < m; ++j)
    for (LinearisedEquations::Sparse::InnerIterator it(e.F, j); it; ++it)
      add(static_cast<int>(it.row()), n + j, it.value());
  SparseC whole(size, size);
  whole.setFromTriplets(entries.begin(), entries.end());
  whole.makeCompressed();
  pattern_ = std::make_unique<const SparsePattern>(
      std::vector<int>(whole.outerIndexPtr(), whole.outerIndexPtr() + whole.outerSize() + 1),
      std::vector<int>(whole.innerIndexPtr(), whole.innerIndexPtr() + whole.nonZeros()));

  set_scale(D);
  scale_of_solutions_.resize(size);
  scale_of_solutions_.head(n) = scale_.head(n);
  for (int k = 0; k < m; ++k) {
    double most = 0;
    const Eigen::SparseVector<double> row = e.B.row(k);
    for (Eigen::SparseVector<double>::InnerIterator it(row); it; ++it)
      most = std::max(most, std::abs(it.value()) * scale_[it.index()]);
    scale_of_solutions_[n + k] = most > 0 ? 1 / most : 1;
  }
  const bool follows = other != nullptr && other->regular_ && other->is_real() == is_real() &&
                       other->pattern_->column_start() == pattern_->column_start() &&
                       other->pattern_->row() == pattern_->row();
  if (follows) pattern_ = std::move(other->pattern_);  // the factors refer to it
  const auto factorise = [&](auto& factors, auto* others, const auto& values) {
    if (follows)
      factors = std::move(*others);
    else
      factors = std::make_unique<std::decay_t<decltype(*factors)>>(*pattern_);
    regular_ =
        factors->factor(values, scale_of_solutions_) == FactorStatus::good && factors->reciprocal_condition() > 0;
    singular_ = factors->singular_column();
  };
  const std::vector<Complex> values(whole.valuePtr(), whole.valuePtr() + whole.nonZeros());
  if (is_real()) {
    std::vector<double> real(values.size());
    std::transform(values.begin(), values.end(), real.begin(), [](const Complex& value) { return value.real(); });
    factorise(factors_, other ? &other->factors_ : nullptr, real);
  } else {
    factorise(complex_factors_, other ? &other->complex_factors_ : nullptr, values);
  }
}

void ShiftedOperator::set_scale(const SparseC& D) {
  const LinearisedEquations& e = equations_;
  const int n = e.unknowns(), dofs = e.dofs;
  const double rate = shift_ == 0.0 ? 1 : std::abs(shift_);
  scale_ = VectorX::Zero(e.states());
  const VectorX mass = e.M.diagonal();
  const VectorX stiffness = D.diagonal().cwiseAbs();
  // Centrifugal terms that cancel leave rounding errors in place of a stiffness (a blade without inertia about its
  // length).
  constexpr double rounding = 1e-12;
  double stiffest[] = {0, 0};  // translations and amplitudes, rotations
  const auto kind = [&](int i) { return !e.turns.empty() && e.turns[static_cast<std::size_t>(i)] != 0 ? 1 : 0; };
  for (int i = 0; i < dofs; ++i) stiffest[kind(i)] = std::max(stiffest[kind(i)], stiffness[i]);
  // Dofs without mass are scaled by the stiffness. Those with neither have the mean scale of the others.
  double sum = 0;
  int known = 0;
  for (int i = 0; i < dofs; ++i) {
    if (mass[i] > 0)
      scale_[i] = 1 / std::sqrt(mass[i]);
    else if (stiffness[i] > rounding * stiffest[kind(i)])
      scale_[i] = rate / std::sqrt(stiffness[i]);
    if (scale_[i] == 0) continue;
    sum += std::log(scale_[i]);
    ++known;
  }
  const double usual = known > 0 ? std::exp(sum / known) : 1;
  for (int i = 0; i < dofs; ++i)
    if (scale_[i] == 0) scale_[i] = usual;
  // The scale of a first-order unknown y follows from D_yy y = -D_yu u and D_uu u = -D_uy y in scaled unknowns.
  VectorX to = VectorX::Zero(n), from = VectorX::Zero(n);
  for (int j = 0; j < n; ++j)
    for (SparseC::InnerIterator it(D, j); it; ++it) {
      const auto i = static_cast<int>(it.row());
      const double size = std::norm(it.value());
      if (i >= dofs && j < dofs && stiffness[i] > 0)
        to[i] += size * scale_[j] * scale_[j] / (stiffness[i] * stiffness[i]);
      if (i < dofs && j >= dofs) from[j] += size * scale_[i] * scale_[i] / std::pow(rate, 4);
    }
  for (int i = dofs; i < n; ++i) {
    const double y = std::sqrt(to[i]), u = std::sqrt(from[i]);
    scale_[i] = y > 0 && u > 0 ? std::sqrt(y / u) : y > 0 ? y : u > 0 ? 1 / u : 1;
  }
  scale_.tail(dofs) = rate * scale_.head(dofs);
}

VectorXc ShiftedOperator::solve(const VectorXc& right) const {
  if (!is_real()) {
    VectorXc x = right;
    complex_factors_->solve(x);
    return x;
  }
  VectorX real = right.real(), imag = right.imag();
  factors_->solve(real);
  if (!imag.isZero(0)) factors_->solve(imag);
  VectorXc x(right.size());
  x.real() = real;
  x.imag() = imag;
  return x;
}

/// Returns the right-hand side for [u; lambda] of T x. @param in  physical state
template <class Vector, class Matrix>
Vector ShiftedOperator::right_side(const Vector& in, const Matrix& rates) const {
  const LinearisedEquations& e = equations_;
  const int n = e.unknowns();
  Vector w = Vector::Zero(n);
  w.head(e.dofs) = in.tail(e.dofs);
  Vector right(n + e.constraints());
  right.head(n) = -(rates * in.head(n)) - e.M * w;
  right.tail(e.constraints()).setZero();
  if (any_nonholonomic_) {
    const Vector of_constraints = e.B * in.head(n);
    for (int k = 0; k < e.constraints(); ++k)
      if (e.nonholonomic[static_cast<std::size_t>(k)]) right[n + k] = -of_constraints[k];
  }
  return right;
}

template <class Vector, class Matrix, class Solve>
Vector ShiftedOperator::apply_with(const Vector& x, const Matrix& rates, typename Vector::Scalar shift,
                                   const Solve& solution_of) const {
  const LinearisedEquations& e = equations_;
  const int n = e.unknowns();
  const Vector in = scale_.template cast<typename Vector::Scalar>().cwiseProduct(x);
  const Vector solution = solution_of(right_side(in, rates));
  Vector out(e.states());
  out.head(n) = solution.head(n);
  out.tail(e.dofs) = (shift * solution.head(n) + e.W * solution.head(n) + in.head(n)).head(e.dofs);
  return out.cwiseQuotient(scale_.template cast<typename Vector::Scalar>());
}

VectorX ShiftedOperator::multipliers(const VectorX& x) const {
  if (!is_real()) throw std::logic_error("a complex shift makes complex vectors");
  VectorX solution = right_side(VectorX(scale_.cwiseProduct(x)), real_rates_);
  factors_->solve(solution);
  return solution.tail(equations_.constraints());
}

VectorXc ShiftedOperator::apply(const VectorXc& x) const {
  if (is_real()) {
    VectorXc y(x.size());
    y.real() = apply(VectorX(x.real()));
    y.imag() = apply(VectorX(x.imag()));
    return y;
  }
  return apply_with(x, rates_, shift_, [&](const VectorXc& right) { return solve(right); });
}

VectorX ShiftedOperator::apply(const VectorX& x) const {
  if (!is_real()) throw std::logic_error("a complex shift makes complex vectors");
  return apply_with(x, real_rates_, shift_.real(), [&](const VectorX& right) {
    VectorX solution = right;
    factors_->solve(solution);
    return solution;
  });
}

}  // namespace bielle::mechanism
