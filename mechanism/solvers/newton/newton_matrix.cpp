#include "mechanism/solvers/newton/newton_matrix.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {

NewtonMatrix::NewtonMatrix(const System& system) : system_(system) {
  take_pattern();
  scales_.setOnes(system.size());
}

/// Finds the diagonal in the system's pattern.
void NewtonMatrix::take_pattern() {
  pattern_ = system_.shared_pattern();
  diagonal_.clear();
  for (std::vector<int>& places : diagonal_by_kind_) places.clear();
  for (int i = 0; i < system_.size(); ++i) diagonal_.push_back(pattern_->whole.find(i, i));
  for (std::size_t k = 0; k < diagonal_by_kind_.size(); ++k)
    for (int i = 0; i < system_.dofs(); ++i)
      if (const int place = diagonal_[static_cast<std::size_t>(i)]; place >= 0 && system_.kind(i) == scaling_kinds[k])
        diagonal_by_kind_[k].push_back(place);
}

void NewtonMatrix::assemble(const State& state, const Environment& environment, const TangentWeights& weights,
                            const VectorX* dq, const VectorX* extra) {
  const bool algebraic = weights.stiffness != 1 && !system_.algebraic().empty();
  // The stiffness is assembled first, because it has all entries that later tangents at the same state may have.
  if (algebraic) system_.tangent(state, environment, TangentWeights{1, 0, 0, 0, 0}, nullptr, stiffness_);
  system_.tangent(state, environment, weights, dq, values_);
  weights_ = weights;
  if (system_.shared_pattern() != pattern_) take_pattern();
  if (algebraic) take_algebraic_columns();
  if (extra)
    for (int i = 0; i < system_.dofs(); ++i)
      if (const int place = diagonal_[static_cast<std::size_t>(i)]; place >= 0)
        values_[static_cast<std::size_t>(place)] += (*extra)[i];
  scale_ = 1;
  for (const std::vector<int>& places : diagonal_by_kind_) {
    double sum = 0;
    for (const int place : places) sum += std::abs(values_[static_cast<std::size_t>(place)]);
    if (!(sum > 0)) continue;
    scale_ = sum / static_cast<double>(places.size());
    break;
  }
  scales_.tail(system_.multipliers()).setConstant(scale_);
}

void NewtonMatrix::take_algebraic_columns() {
  for (const int k : system_.algebraic()) {
    const auto column = pattern_->whole.column_start().begin() + system_.dofs() + k;
    std::copy(stiffness_.begin() + column[0], stiffness_.begin() + column[1], values_.begin() + column[0]);
  }
}

bool NewtonMatrix::try_factor(const State& state, const Environment& environment, const TangentWeights& weights,
                              const VectorX* dq, const VectorX* extra) {
  assemble(state, environment, weights, dq, extra);
  if (!factors_ || factored_pattern_ != pattern_) {
    factors_.reset();  // the factors are destroyed before the pattern to which they refer
    factored_pattern_ = pattern_;
    factors_.emplace(factored_pattern_->condensed);
  }
  return factors_->factor(values_, scales_, system_.workers()) == FactorStatus::good;
}

void NewtonMatrix::factor(const State& state, const Environment& environment, const TangentWeights& weights,
                          const VectorX* dq) {
  if (!try_factor(state, environment, weights, dq)) throw_singular(state.time);
}

bool NewtonMatrix::nearly_singular() const { return factors_->reciprocal_condition() < 1e-13; }

void NewtonMatrix::throw_singular(double time) const {
  const int column = factors_ ? factors_->singular_column() : -1;
  const std::string what = column >= 0 ? system_.unknown_name(column) : "an unknown";
  const char* why = "it has no mass, or nothing holds it, or constraints next to it are redundant";
  if (column >= system_.size() - system_.multipliers())
    why = "the constraint repeats what others hold already (redundant)";
  else if (column >= system_.dofs())
    why = "no equation determines it there";
  throw ComputationError(fmt::format("t = {:.6g} s: the equations are singular at {}: {}", time, what, why));
}

void NewtonMatrix::solve(const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) const {
  delta = -r;
  factors_->solve(delta);
}

void NewtonMatrix::row_sums(const Eigen::Ref<const VectorX>& unknown_scale, Eigen::Ref<VectorX> sums) const {
  const SparsePattern& pattern = pattern_->whole;
  sums.setZero();
  for (int column = 0; column < pattern.size(); ++column)
    for (int k = pattern.column_start()[static_cast<std::size_t>(column)];
         k < pattern.column_start()[static_cast<std::size_t>(column) + 1]; ++k)
      sums[pattern.row()[static_cast<std::size_t>(k)]] +=
          std::abs(values_[static_cast<std::size_t>(k)]) * unknown_scale[column];
}

double NewtonMatrix::diagonal(int unknown) const {
  const int place = diagonal_[static_cast<std::size_t>(unknown)];
  return place < 0 ? 0 : values_[static_cast<std::size_t>(place)];
}

}  // namespace bielle::mechanism
