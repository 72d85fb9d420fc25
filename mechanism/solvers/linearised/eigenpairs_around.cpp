#include "mechanism/solvers/linearised/eigenpairs_around.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/solvers/linearised/finite_states.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "mechanism/solvers/linearised/orthonormal.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/spectral/operator_eigenpairs.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using VectorXc = Eigen::VectorXcd;
using MatrixXc = Eigen::MatrixXcd;

/// Finds eigenpairs of the operator on the orthogonal complement of Q, in coordinates of the basis if one is given.
template <class Scalar>
OperatorEigenpairs search_complement(const ShiftedOperator& T, const MatrixX& Q, const MatrixX* basis,
                                     Eigen::Index count, const OperatorEigenOptions& options) {
  using Vector = Eigen::Vector<Scalar, Eigen::Dynamic>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  if (basis) {
    const Matrix& V = basis->cast<Scalar>();
    return largest_eigenpairs(
        LinearOperator<Scalar>{V.cols(),
                               [&](const Vector& z) { return Vector(V.transpose() * T.apply(Vector(V * z))); }},
        count, options);
  }
  const Matrix& known = Q.cast<Scalar>();
  const auto without = [&](Vector x) {
    for (int twice = 0; twice < 2 && known.cols() > 0; ++twice) {
      const Vector parts = known.transpose() * x;
      x -= known * parts;
    }
    return x;
  };
  return largest_eigenpairs(
      LinearOperator<Scalar>{T.scale().size(), [&](const Vector& x) { return without(T.apply(without(x))); }}, count,
      options);
}

}  // namespace

void EigenpairsAround::keep_out(const MatrixX& states) {
  MatrixX all(e_.states(), known_.cols() + states.cols());
  all << MatrixX(known_.cols() > 0 ? known_ : MatrixX(e_.states(), 0)), states;
  known_ = std::move(all);
}

bool EigenpairsAround::dense() const {
  constexpr int most = 2000;  // limit of states for the null space of the constraints
  return e_.states() - 2 * e_.constraints() <= dense_ && e_.states() <= most && dense_ > 0;
}

void EigenpairsAround::set_shift(Complex shift) {
  constexpr double factors[] = {1, 1.0137, 13.7, 1370, 1.37e5};
  for (const double factor : factors) {
    if (factor > 2 && shift.real() == 0) break;  // an imaginary shift is a requested frequency
    operator_ = std::make_unique<ShiftedOperator>(e_, factor * shift);
    if (operator_->regular()) break;
  }
  if (!operator_->regular()) throw SingularEquations(operator_->singular());
  const ShiftedOperator& T_now = *operator_;
  Q_ = MatrixX(e_.states(), 0);
  if (known_.cols() > 0) Q_ = orthonormal_columns(MatrixX(T_now.scale().cwiseInverse().asDiagonal() * known_));
  TQ_.resize(Q_.cols(), Q_.cols());
  for (Eigen::Index k = 0; k < Q_.cols(); ++k)
    TQ_.col(k) = Q_.transpose().cast<Complex>() * T_now.apply(VectorXc(Q_.col(k).cast<Complex>()));
  if (!dense()) return;
  basis_ = consistent_states(e_, T_now.scale());
  constexpr double dependent = 1e-8;
  if (Q_.cols() > 0 && basis_.cols() > 0)
    basis_ = (basis_ * null_space(MatrixX(Q_.transpose() * basis_), dependent)).eval();
}

/// Recovers the eigenvector from its part z outside of the known states Q. If the known states have this eigenvalue
/// too, and both share a single vector, the result is that vector.
VectorXc EigenpairsAround::recovered(Complex mu, const VectorXc& z) const {
  if (Q_.cols() == 0) return z;
  const VectorXc coupled = Q_.transpose().cast<Complex>() * operator_->apply(z);
  MatrixXc A = -TQ_;
  A.diagonal().array() += mu;
  MatrixX whole(2 * A.rows(), 2 * A.rows());
  whole << A.real(), -A.imag(), A.imag(), A.real();
  VectorX right(whole.rows());
  right << coupled.real(), coupled.imag();
  constexpr double farthest = 1e7;
  if (const auto inverse = regular_inverse(whole)) {
    const VectorX both = *inverse * right;
    VectorXc c(coupled.size());
    c.real() = both.head(c.size());
    c.imag() = both.tail(c.size());
    if (c.norm() < farthest * z.norm()) return z + Q_.cast<Complex>() * c;
  }
  const VectorXc own = Q_.cast<Complex>() * coupled;
  return own.norm() > 0 ? VectorXc(own / own.norm()) : z;
}

/// Makes eigenvalues real that only rounding errors make complex. With a real operator, copies of a multiple real
/// eigenvalue appear as conjugate pairs; with a complex operator, vectors are complex multiples of real ones. These
/// eigenvalues get real vectors of the same space, unless the vectors are not eigenvectors: a double eigenvalue may
/// have a single one.
void EigenpairsAround::make_real(std::vector<Eigenpair>& pairs) const {
  constexpr double rounding = 1e-9, accurate = 1e-6;
  const auto is_real = [](Complex s) { return std::abs(s.imag()) <= rounding * std::abs(s); };
  const VectorX& scale = operator_->scale();
  std::vector<char> done(pairs.size(), 0);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (done[k] != 0 || !is_real(pairs[k].s)) continue;
    const double first = pairs[k].s.real();
    std::vector<std::size_t> copies;
    double sum = 0, imaginary = 0;
    for (std::size_t j = k; j < pairs.size(); ++j) {
      const Complex s = pairs[j].s;
      if (done[j] != 0 || !is_real(s) || std::abs(s.real() - first) > rounding * std::abs(first)) continue;
      done[j] = 1;
      copies.push_back(j);
      sum += s.real();
      imaginary = std::max({imaginary, std::abs(s.imag()), pairs[j].x.imag().cwiseAbs().maxCoeff()});
      pairs[j].s = s.real();
    }
    if (imaginary == 0) continue;
    const auto count = static_cast<Eigen::Index>(copies.size());
    MatrixX parts(scale.size(), 2 * count);
    for (Eigen::Index j = 0; j < count; ++j) {
      const VectorXc& x = pairs[copies[static_cast<std::size_t>(j)]].x;
      parts.col(2 * j) = x.real().cwiseQuotient(scale);
      parts.col(2 * j + 1) = x.imag().cwiseQuotient(scale);
    }
    const MatrixX X = leading_directions(parts, count);
    const double s = sum / static_cast<double>(count);
    const Complex mu = 1.0 / (s - operator_->shift());
    VectorX residuals(X.cols());
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      const VectorXc x = X.col(j).cast<Complex>();
      residuals[j] = (operator_->apply(x) / mu - x).norm();
    }
    if (X.cols() < count || !(residuals.maxCoeff() <= accurate)) continue;
    for (Eigen::Index j = 0; j < count; ++j) {
      const VectorX x = X.col(j), z = x - Q_ * (Q_.transpose() * x).eval();
      pairs[copies[static_cast<std::size_t>(j)]] = {s, scale.cwiseProduct(x).cast<Complex>(),
                                                    scale.cwiseProduct(z).cast<Complex>(), residuals[j]};
    }
  }
}

EigenpairsNearby EigenpairsAround::look(Eigen::Index count, Look how) const {
  const ShiftedOperator& now = *operator_;
  OperatorEigenOptions options;
  options.dense = dense() ? basis_.cols() : 0;
  if (!dense() && how == Look::roughly) options.tolerance = 1e-6;
  if (!dense() && how != Look::exactly) options.copies = false;
  const MatrixX* basis = dense() ? &basis_ : nullptr;
  const OperatorEigenpairs found = now.is_real() ? search_complement<double>(now, Q_, basis, count, options)
                                                 : search_complement<Complex>(now, Q_, basis, count, options);
  EigenpairsNearby nearby;
  nearby.radius = found.all ? INFINITY : 1 / std::abs(found.values[found.values.size() - 1]);
  for (Eigen::Index k = 0; k < found.values.size(); ++k) {
    const Complex mu = found.values[k];
    if (mu == 0.0) continue;
    VectorXc z = found.vectors.col(k);
    if (basis) z = basis->cast<Complex>() * z;
    VectorXc x = recovered(mu, z);
    // The operator removes eigenvectors of infinite eigenvalues.
    const VectorXc once = now.apply(x) / mu;
    constexpr double same = 1e-2;
    if (!((now.apply(once) / mu - x).norm() < same * x.norm())) {
      nearby.rejected = true;
      continue;
    }
    const auto scale = now.scale().cast<Complex>();
    nearby.pairs.push_back({now.shift() + 1.0 / mu, scale.cwiseProduct(once / once.norm()), scale.cwiseProduct(z),
                            (once - x).norm() / x.norm()});
  }
  make_real(nearby.pairs);
  return nearby;
}

}  // namespace bielle::mechanism
