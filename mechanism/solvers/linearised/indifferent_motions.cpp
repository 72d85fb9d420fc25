#include "mechanism/solvers/linearised/indifferent_motions.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "mechanism/solvers/linearised/equation_products.hpp"
#include "mechanism/solvers/linearised/equation_symmetry.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "mechanism/solvers/linearised/orthonormal.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/spectral/operator_eigenpairs.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using VectorXc = Eigen::VectorXcd;
using MatrixXc = Eigen::MatrixXcd;

/// Returns numbers of both signs, the same in every run.
VectorX signs(Eigen::Index size) {
  VectorX result(size);
  for (Eigen::Index i = 0; i < size; ++i) result[i] = std::sin(1.0 + 2.399963 * static_cast<double>(i)) < 0 ? -1 : 1;
  return result;
}

class IndifferentSearch {
 public:
  IndifferentSearch(const LinearisedEquations& equations, EquationRounding& rounding, Eigen::Index dense)
      : e_(equations), rounding_(rounding), dense_(dense), symmetry_(equation_symmetry(equations)) {}

  IndifferentMotions run() {
    constexpr double softer = 1e-3, of_fastest = 1e-6, lower = 1.0 / 30;
    constexpr int tries = 4;
    const double least = of_fastest * fastest_rate(e_);
    double rate = std::max(softer * slowest_rate(e_), 30 * least);
    for (int k = 0; k < tries; ++k, rate = std::max(least, lower * rate)) {
      if (!set_rate(rate)) continue;
      note_uncertain_reactions();
      const bool last = k + 1 == tries || rate <= least;
      try {
        if (!find_soft(last)) continue;
      } catch (const ComputationError&) {
        if (last) throw;
        continue;  // too many motions are slow relative to the rate
      }
      return decide();
    }
    return {MatrixX(e_.unknowns(), 0), 0, 0};
  }

 private:
  bool set_rate(double rate) {
    constexpr double factors[] = {1, 1.0137, 1.37};
    for (const double factor : factors) {
      right_ = std::make_unique<ShiftedOperator>(e_, factor * rate);
      if (!right_->regular()) continue;
      left_.reset();
      if (symmetry_ == EquationSymmetry::symmetric) return true;
      left_ = std::make_unique<ShiftedOperator>(e_, factor * rate, ShiftedOperator::Side::left);
      if (left_->regular()) return true;
    }
    return false;
  }
  double sigma() const { return right_->shift().real(); }
  auto scale() const { return right_->scale().head(e_.unknowns()); }

  /// Notes the response of reactions to forces that are zero up to errors.
  void note_uncertain_reactions() {
    const int n = e_.unknowns();
    if (e_.left_over.size() != n || e_.constraints() == 0) return;
    VectorXc forces = VectorXc::Zero(n + e_.constraints());
    forces.head(n).real() = e_.left_over.cwiseProduct(signs(n));
    rounding_.set_uncertain_reactions(right_->solve(forces).tail(e_.constraints()).real());
  }

  /// Returns R u, with the rows of the constraints.
  VectorX resisted(const VectorX& u) const { return resistance_times(e_, sigma(), u); }
  /// Returns R^T y; the rows of the constraints are zero.
  VectorX transposed_resisted(const VectorX& y) const {
    const int n = e_.unknowns();
    const VectorX v = y.head(n), pushed = e_.M.transpose() * v;
    VectorX held = y.tail(e_.constraints());
    for (int k = 0; k < e_.constraints(); ++k)
      if (!e_.nonholonomic[static_cast<std::size_t>(k)]) held[k] = 0;
    return sigma() * (e_.C.transpose() * v + sigma() * pushed + e_.W.transpose() * pushed + e_.B.transpose() * held);
  }

  /// Returns D(sigma)^-1 R u for scaled unknowns.
  VectorX answer(const VectorX& x) const {
    return right_->solve(resisted(scale().cwiseProduct(x)).cast<Complex>())
        .head(e_.unknowns())
        .real()
        .cwiseQuotient(scale());
  }
  /// Returns R^T D(sigma)^-T z for scaled forces z.
  VectorX left_answer(const VectorX& z) const { return scale().cwiseProduct(transposed_resisted(left_of(z))); }
  VectorX left_of(const VectorX& z) const {
    VectorXc forces = VectorXc::Zero(e_.unknowns() + e_.constraints());
    forces.head(e_.unknowns()).real() = z.cwiseQuotient(scale());
    return left_->solve(forces).real();
  }

  struct Soft {
    MatrixX basis;         ///< basis of scaled vectors with eigenvalues near 1
    double others = 0;     ///< the largest other eigenvalue
    bool crowded = false;  ///< there are more than were requested
  };
  template <class Apply>
  Soft soft_ones(const Apply& apply, bool whatever) const {
    constexpr double next_to_one = 0.5;
    constexpr Eigen::Index most = 60;
    OperatorEigenOptions options;
    options.dense = dense_;
    options.tolerance = 1e-8;
    const LinearOperator<double> G{e_.unknowns(), apply};
    for (Eigen::Index count = 14;; count *= 2) {
      const OperatorEigenpairs found = largest_eigenpairs(G, std::min<Eigen::Index>(count, e_.unknowns()), options);
      Soft soft;
      std::vector<VectorX> parts;
      Eigen::Index near = 0;
      for (Eigen::Index k = 0; k < found.values.size(); ++k) {
        if (std::abs(found.values[k] - 1.0) >= next_to_one) {
          soft.others = std::max(soft.others, std::abs(found.values[k]));
          continue;
        }
        ++near;
        if (found.values[k].imag() < 0) continue;
        parts.emplace_back(found.vectors.col(k).real());
        if (found.values[k].imag() > 0 || found.vectors.col(k).imag().norm() > 0)
          parts.emplace_back(found.vectors.col(k).imag());
      }
      soft.crowded = !found.all && near >= found.values.size() - 2;
      if (soft.crowded && (whatever || count < most) && 4 * count + 20 < e_.unknowns()) continue;
      MatrixX vectors(e_.unknowns(), static_cast<Eigen::Index>(parts.size()));
      for (std::size_t k = 0; k < parts.size(); ++k) vectors.col(static_cast<Eigen::Index>(k)) = parts[k];
      soft.basis = leading_directions(vectors, near);
      constexpr int rounds = 2;
      for (int round = 0; round < rounds && soft.basis.cols() > 0; ++round) {
        for (Eigen::Index k = 0; k < soft.basis.cols(); ++k) soft.basis.col(k) = apply(VectorX(soft.basis.col(k)));
        soft.basis = orthonormal_columns(soft.basis);
      }
      return soft;
    }
  }

  /// @returns false if so many motions are slow relative to the rate that another rate is better
  bool find_soft(bool whatever) {
    Soft right = soft_ones([&](const VectorX& x) { return answer(x); }, whatever);
    if (right.crowded && !whatever) return false;
    others_ = right.others;
    X_ = scale().asDiagonal() * right.basis;
    if (!left_) {
      Y_ = MatrixX::Zero(e_.unknowns() + e_.constraints(), X_.cols());
      Y_.topRows(e_.unknowns()) = X_;
      return true;
    }
    const Soft left = soft_ones([&](const VectorX& z) { return left_answer(z); }, true);
    if (left.basis.cols() != X_.cols()) return false;
    Y_.resize(e_.unknowns() + e_.constraints(), X_.cols());
    for (Eigen::Index k = 0; k < X_.cols(); ++k) Y_.col(k) = left_of(left.basis.col(k));
    return true;
  }

  IndifferentMotions decide() const {
    IndifferentMotions result{MatrixX(e_.unknowns(), 0), 0, 0};
    const auto k = X_.cols();
    double least = others_ > 0 ? std::abs(1 / others_ - 1) : 0;
    if (k > 0) {
      MatrixX A(k, k), R(k, k);
      for (Eigen::Index j = 0; j < k; ++j) {
        VectorXc u = VectorXc::Zero(Y_.rows());
        u.head(e_.unknowns()).real() = X_.col(j);
        A.col(j) = Y_.transpose() * equations_times(e_, 0, u).real();
        R.col(j) = Y_.transpose() * resisted(X_.col(j));
      }
      const std::vector<Ritz> all = left_ ? pairs(A, R) : symmetric_pairs(A, R);
      std::vector<VectorX> parts;
      Eigen::Index number = 0;
      for (const Ritz& each : all) {
        const VectorXc x = X_.cast<Complex>() * each.x, y = Y_.topRows(e_.unknowns()).cast<Complex>() * each.y;
        const double delta = rounding_(y, 0, x);
        // Accuracy of R for motions with neither stiffness nor left vectors (rolling, integrals).
        constexpr double of_resistance = 1e-13;
        if (std::abs(each.tau) > std::max(delta, of_resistance)) {
          least = least > 0 ? std::min(least, std::abs(each.tau)) : std::abs(each.tau);
          continue;
        }
        ++number;
        result.resolution = std::max(result.resolution, sigma() * std::sqrt(delta));
        parts.emplace_back(x.real().cwiseQuotient(scale()));
        parts.emplace_back(x.imag().cwiseQuotient(scale()));
      }
      MatrixX vectors(e_.unknowns(), static_cast<Eigen::Index>(parts.size()));
      for (std::size_t j = 0; j < parts.size(); ++j) vectors.col(static_cast<Eigen::Index>(j)) = parts[j].normalized();
      for (Eigen::Index j = 0; j < vectors.cols(); ++j)
        if (!vectors.col(j).allFinite()) vectors.col(j).setZero();
      result.shapes = scale().asDiagonal() * leading_directions(vectors, number);
    }
    result.slowest = sigma() * std::sqrt(least);
    return result;
  }

  /// A pair of A x = tau R x with y^T R x = 1.
  struct Ritz {
    Complex tau;
    VectorXc x, y;
  };
  static std::vector<Ritz> symmetric_pairs(const MatrixX& A, const MatrixX& R) {
    std::vector<Ritz> result;
    if (const auto found = symmetric_eigenpairs(MatrixX(0.5 * (A + A.transpose())), MatrixX(0.5 * (R + R.transpose()))))
      for (Eigen::Index k = 0; k < A.cols(); ++k)
        result.push_back(
            {found->values[k], found->vectors.col(k).cast<Complex>(), found->vectors.col(k).cast<Complex>()});
    else
      return pairs(A, R);
    return result;
  }
  static std::vector<Ritz> pairs(const MatrixX& A, const MatrixX& R) {
    std::vector<Ritz> result;
    const auto k = A.cols();
    const auto inverse = regular_inverse(R);
    if (!inverse) return result;
    const MatrixX T = *inverse * A;
    OperatorEigenOptions dense;
    dense.dense = k;
    const OperatorEigenpairs found =
        largest_eigenpairs(LinearOperator<double>{k, [&](const VectorX& x) { return VectorX(T * x); }}, k, dense);
    MatrixX whole(2 * k, 2 * k);
    whole << found.vectors.real(), -found.vectors.imag(), found.vectors.imag(), found.vectors.real();
    const auto rows = regular_inverse(whole);
    constexpr double nearly_defective = 1e8;
    if (!rows || !(rows->norm() < nearly_defective)) return singular_pairs(T, *inverse);
    for (Eigen::Index j = 0; j < k; ++j) {
      Ritz ritz{found.values[j], found.vectors.col(j), VectorXc(k)};
      ritz.y.real() = inverse->transpose() * rows->row(j).head(k).transpose();
      ritz.y.imag() = -(inverse->transpose() * rows->row(j).tail(k).transpose());
      result.push_back(std::move(ritz));
    }
    return result;
  }
  /// If eigenvalues have fewer vectors than their multiplicity, singular values are used instead. These are zero for
  /// the same vectors.
  static std::vector<Ritz> singular_pairs(const MatrixX& T, const MatrixX& inverse) {
    std::vector<Ritz> result;
    const RightSingularVectors right = right_singular_vectors(T), left = right_singular_vectors(MatrixX(T.transpose()));
    for (Eigen::Index j = 0; j < T.cols(); ++j)
      result.push_back({right.values[j], right.vectors.col(j).cast<Complex>(),
                        VectorX(inverse.transpose() * left.vectors.col(j)).cast<Complex>()});
    return result;
  }

  const LinearisedEquations& e_;
  EquationRounding& rounding_;
  Eigen::Index dense_;
  EquationSymmetry symmetry_;
  std::unique_ptr<ShiftedOperator> right_, left_;
  MatrixX X_, Y_;  ///< soft motions, and left vectors (n + constraints)
  double others_ = 0;
};

}  // namespace

IndifferentMotions find_indifferent_motions(const LinearisedEquations& equations, EquationRounding& rounding,
                                            Eigen::Index dense) {
  return IndifferentSearch(equations, rounding, dense).run();
}

}  // namespace bielle::mechanism
