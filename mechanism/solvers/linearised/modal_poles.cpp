#include "mechanism/solvers/linearised/modal_poles.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/linearised/equation_products.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;
using VectorXc = Eigen::VectorXcd;
using MatrixXc = Eigen::MatrixXcd;
using SparseC = Eigen::SparseMatrix<Complex>;

/// Returns the size of the terms of D'(s) q in each row of the motion.
VectorX derivative_terms(const LinearisedEquations& e, Complex s, const VectorXc& q) {
  const VectorXc u = q.head(e.unknowns()), turned = e.W.cast<Complex>() * u;
  return (e.M.cast<Complex>() * u).cwiseAbs() * (2 * std::abs(s)) + (e.M.cast<Complex>() * turned).cwiseAbs() +
         (e.C.cast<Complex>() * u).cwiseAbs();
}

/// Returns groups of equal eigenvalues, as indices of their modes.
std::vector<std::vector<std::size_t>> equal_ones(const std::vector<Mode>& modes) {
  constexpr double same = 1e-7;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    if (modes[k].kind == ModeKind::rigid) continue;
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<std::size_t>& each) {
      return std::abs(modes[each.front()].s - modes[k].s) <= same * std::abs(modes[k].s);
    });
    if (group == groups.end())
      groups.push_back({k});
    else
      group->push_back(k);
  }
  return groups;
}

class PoleFinder {
 public:
  PoleFinder(const LinearisedEquations& equations, const ShiftedOperator& T) : e_(equations), T_(T) {
    scale_ = VectorX::Ones(e_.unknowns() + e_.constraints());
    scale_.head(e_.unknowns()) = T.scale().head(e_.unknowns());
  }

  /// Returns the shape with its multipliers.
  VectorXc right_vector(const Mode& mode) const {
    VectorXc x(e_.states()), v(e_.unknowns() + e_.constraints());
    x << mode.u, mode.w;
    x = x.cwiseQuotient(T_.scale().cast<Complex>());
    VectorXc multipliers(e_.constraints());
    multipliers.real() = T_.multipliers(VectorX(x.real()));
    multipliers.imag() = T_.multipliers(VectorX(x.imag()));
    v << mode.u, (mode.s - T_.shift()) * multipliers;
    return v / scaled(v).norm();
  }

  void add(const std::vector<Mode>& modes, const std::vector<std::size_t>& group, std::vector<ModalPole>& poles) const {
    const auto count = static_cast<Eigen::Index>(group.size());
    const Complex s = modes[group.front()].s;
    MatrixXc right(scale_.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) right.col(k) = right_vector(modes[group[static_cast<std::size_t>(k)]]);
    MatrixXc left = left_vectors(s, right);
    MatrixXc changes(scale_.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) changes.col(k) = equations_derivative_times(e_, s, right.col(k));
    for (Eigen::Index k = 0; k < count; ++k)
      left.col(k) /= scaled(left.col(k)).norm() * size_of(derivative_terms(e_, s, right.col(k)).cast<Complex>());
    const MatrixXc pairing = left.transpose() * changes;
    const auto inverse = regular_inverse(real_form(MatrixXc(pairing.transpose())));
    constexpr double nearly_defective = 1e6;
    if (!inverse || !(inverse->norm() < nearly_defective)) throw_defective(s);
    left = (left * complex_form(*inverse)).eval();
    for (Eigen::Index k = 0; k < count; ++k)
      poles.push_back({modes[group[static_cast<std::size_t>(k)]].s, right.col(k), left.col(k)});
  }

 private:
  VectorXc scaled(const VectorXc& v) const { return v.head(e_.unknowns()).cwiseQuotient(scale_.head(e_.unknowns())); }

  /// Returns the size of forces, scaled to displacements.
  double size_of(const VectorXc& forces) const {
    return forces.head(e_.unknowns()).cwiseProduct(scale_.head(e_.unknowns()).cast<Complex>()).norm();
  }

  /// Returns the size of y^T D(s), relative to inertial forces.
  double left_residual(Complex s, const VectorXc& y) const {
    // In scaled unknowns, M has a diagonal of ones, and inertial forces have the size |s|^2.
    return size_of(transposed_equations_times(e_, s, y)) / (std::norm(s) * scaled(y).norm());
  }

  /// Returns the left vectors. For symmetric equations these are the right ones, for undamped gyroscopic equations
  /// their conjugates; others are found by iteration.
  MatrixXc left_vectors(Complex s, const MatrixXc& right) const {
    constexpr double exact = 1e-9;
    for (const bool conjugate : {false, true}) {
      const MatrixXc candidates = conjugate ? MatrixXc(right.conjugate()) : right;
      bool fits = true;
      for (Eigen::Index k = 0; k < candidates.cols() && fits; ++k) fits = left_residual(s, candidates.col(k)) <= exact;
      if (fits) return candidates;
    }
    return iterated(s, right);
  }

  /// Finds left vectors by inverse iteration with the transposed equations and a shift next to the eigenvalue.
  MatrixXc iterated(Complex s, const MatrixXc& right) const {
    constexpr double next_to = 1e-7;
    constexpr int rounds = 4;
    MatrixXc left = right.conjugate();
    for (const double factor : {1.0, 3.0, 10.0}) {
      const ShiftedOperator transposed(e_, s * (1 + factor * next_to), ShiftedOperator::Side::left);
      if (!transposed.regular()) continue;
      for (int round = 0; round < rounds; ++round) {
        MatrixXc next(left.rows(), left.cols());
        for (Eigen::Index k = 0; k < left.cols(); ++k) {
          VectorXc start = VectorXc::Zero(left.rows());
          start.head(e_.unknowns()) = scaled(left.col(k)).cwiseQuotient(scale_.head(e_.unknowns()).cast<Complex>());
          VectorXc y = transposed.solve(start);
          for (int twice = 0; twice < 2; ++twice)
            for (Eigen::Index j = 0; j < k; ++j) y -= next.col(j) * scaled(next.col(j)).dot(scaled(y));
          next.col(k) = y / scaled(y).norm();
        }
        left = next;
      }
      return left;
    }
    throw_defective(s);
  }

  static MatrixX real_form(const MatrixXc& A) {
    MatrixX whole(2 * A.rows(), 2 * A.cols());
    whole << A.real(), -A.imag(), A.imag(), A.real();
    return whole;
  }
  static MatrixXc complex_form(const MatrixX& whole) {
    const auto rows = whole.rows() / 2, columns = whole.cols() / 2;
    MatrixXc A(rows, columns);
    A.real() = whole.topLeftCorner(rows, columns);
    A.imag() = whole.bottomLeftCorner(rows, columns);
    return A;
  }

  [[noreturn]] static void throw_defective(Complex s) {
    throw ComputationError(fmt::format(
        "modes cannot be superposed: the eigenvalue {:.6g} {:+.6g} i 1/s has fewer shapes than its multiplicity (it is "
        "defective, or nearly so), and responses are not sums of modes there: leave `modes` out",
        s.real(), s.imag()));
  }

  const LinearisedEquations& e_;
  const ShiftedOperator& T_;
  VectorX scale_;
};

}  // namespace

std::vector<ModalPole> modal_poles(const LinearisedEquations& equations, const std::vector<Mode>& modes) {
  std::vector<ModalPole> poles;
  const auto slowest =
      std::find_if(modes.begin(), modes.end(), [](const Mode& mode) { return mode.kind != ModeKind::rigid; });
  if (slowest == modes.end()) return poles;
  for (const double factor : {1.0, 1.0137, 1.3}) {
    const ShiftedOperator T(equations, 0.9 * factor * std::abs(slowest->s));
    if (!T.regular()) continue;
    const PoleFinder finder(equations, T);
    for (const std::vector<std::size_t>& group : equal_ones(modes)) finder.add(modes, group, poles);
    return poles;
  }
  throw ComputationError("the linearised equations are singular at every frequency (`eigen` names the cause)");
}

}  // namespace bielle::mechanism
