#include "mechanism/solvers/linearised/turn_integration.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include <Eigen/LU>

#include "mechanism/math/sparse_factors.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Sparse = LinearisedEquations::Sparse;
constexpr int stages = 3;

/// Places of the stages in the step, and their matrix A.
struct RadauStages {
  std::array<double, stages> c;
  Matrix3 A;

  RadauStages() {
    const double r = std::sqrt(6.0);
    c = {(4 - r) / 10, (4 + r) / 10, 1};
    A << (88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225,  //
        (296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225,   //
        (16 - r) / 36, (16 + r) / 36, 1.0 / 9;
  }
};

/// The equations of one step for u and l of the stages.
class StepEquations {
 public:
  /// @param D  A^-1/t @param scale  sizes of the unknowns and multipliers
  StepEquations(const Matrix3& D, const VectorX& scale) : D_(D), g_(D.rowwise().sum()), scale_(scale) {}

  /// @param e  equations at the stages
  void set(const std::array<LinearisedEquations, stages>& e) {
    std::vector<Eigen::Triplet<double>> entries;
    const int n = e[0].unknowns(), m = e[0].constraints(), size = n + m;
    const Matrix3 DD = D_ * D_;
    const auto add = [&](const Sparse& part, double factor, int row, int column) {
      for (int j = 0; j < part.outerSize(); ++j)
        for (Sparse::InnerIterator it(part, j); it; ++it)
          entries.emplace_back(row + static_cast<int>(it.row()), column + j, factor * it.value());
    };
    for (int i = 0; i < stages; ++i) {
      const LinearisedEquations& at = e[static_cast<std::size_t>(i)];
      const Sparse MW = at.M * at.W, CW = at.C * at.W, BW = at.B * at.W;
      const int row = i * size;
      for (int j = 0; j < stages; ++j) {
        add(at.M, DD(i, j), row, j * size);
        add(MW, D_(i, j), row, j * size);
        add(at.C, D_(i, j), row, j * size);
      }
      add(CW, 1, row, row);
      add(at.K, 1, row, row);
      add(Sparse(at.B.transpose()), 1, row, row + n);
      add(at.F, 1, row, row + n);
      for (int column = 0; column < n; ++column) {
        const auto add_rows = [&](const Sparse& part, double factor, int to, bool nonholonomic) {
          for (Sparse::InnerIterator it(part, column); it; ++it)
            if ((at.nonholonomic[static_cast<std::size_t>(it.row())] != 0) == nonholonomic)
              entries.emplace_back(row + n + static_cast<int>(it.row()), to + column, factor * it.value());
        };
        add_rows(at.B, 1, row, false);
        for (int j = 0; j < stages; ++j) add_rows(at.B, D_(i, j), j * size, true);
        add_rows(BW, 1, row, true);
        add_rows(at.S, 1, row, true);
      }
    }
    Sparse whole(stages * size, stages * size);
    whole.setFromTriplets(entries.begin(), entries.end());
    if (!factors_ || whole.nonZeros() != pattern_->entry_count()) {
      factors_.reset();
      pattern_ = std::make_unique<const SparsePattern>(
          std::vector<int>(whole.outerIndexPtr(), whole.outerIndexPtr() + whole.outerSize() + 1),
          std::vector<int>(whole.innerIndexPtr(), whole.innerIndexPtr() + whole.nonZeros()));
      factors_ = std::make_unique<SparseLU>(*pattern_);
    }
    const std::vector<double> values(whole.valuePtr(), whole.valuePtr() + whole.nonZeros());
    if (factors_->factor(values, scale_.replicate(stages, 1)) != FactorStatus::good)
      throw ComputationError("the equations of a step over the turn are singular");
  }

  /// Advances states by the step. @param e  equations at the stages, those of `set`
  void advance(const std::array<LinearisedEquations, stages>& e, MatrixX& states) const {
    const int n = e[0].unknowns(), m = e[0].constraints(), size = n + m, dofs = e[0].dofs;
    const MatrixX u = states.topRows(n);
    MatrixX w = MatrixX::Zero(n, states.cols());
    w.topRows(dofs) = states.bottomRows(dofs);
    const Vector3 Dg = D_ * g_;
    MatrixX right = MatrixX::Zero(stages * size, states.cols());
    for (int i = 0; i < stages; ++i) {
      const LinearisedEquations& at = e[static_cast<std::size_t>(i)];
      right.middleRows(i * size, n) = at.M * MatrixX(Dg[i] * u + g_[i] * w) + g_[i] * (at.C * u);
      const MatrixX moved = g_[i] * (at.B * u);
      for (int k = 0; k < m; ++k)
        if (at.nonholonomic[static_cast<std::size_t>(k)] != 0) right.row(i * size + n + k) = moved.row(k);
    }
    factors_->solve_columns(right);
    const MatrixX last = right.middleRows((stages - 1) * size, n);
    MatrixX rates = e[0].W * last - g_[stages - 1] * u;
    for (int j = 0; j < stages; ++j) rates += D_(stages - 1, j) * right.middleRows(j * size, n);
    states.topRows(n) = last;
    states.bottomRows(dofs) = rates.topRows(dofs);
  }

 private:
  const Matrix3 D_;
  const Vector3 g_;
  const VectorX scale_;
  std::unique_ptr<const SparsePattern> pattern_;
  std::unique_ptr<SparseLU> factors_;
};

}  // namespace

TurnIntegration::TurnIntegration(const PeriodicEquations& equations, int steps)
    : equations_(equations), steps_(steps) {}

double TurnIntegration::duration() const { return 2 * std::numbers::pi / std::abs(equations_.rate()); }

MatrixX TurnIntegration::after_turn(MatrixX states, const Observer& observe) const {
  static const RadauStages radau;
  const Matrix3 D = radau.A.inverse() / (duration() / steps_);
  StepEquations step(D, ShiftedOperator(equations_.first(), D(2, 2)).scale_of_solutions());
  const double turn = std::copysign(2 * std::numbers::pi, equations_.rate());
  for (int k = 0; k < steps_; ++k) {
    if (observe) observe(k, states);
    std::array<LinearisedEquations, stages> e;
    for (std::size_t i = 0; i < stages; ++i) e[i] = equations_.at(turn * (k + radau.c[i]) / steps_);
    step.set(e);
    step.advance(e, states);
  }
  return states;
}

}  // namespace bielle::mechanism
