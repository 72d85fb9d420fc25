#include "mechanism/math/sparse.hpp"

#include <algorithm>
#include <stdexcept>

#include <klu.h>

namespace bielle::mechanism {

SparsePattern::SparsePattern(int size, std::vector<std::pair<int, int>> entries) : size_(size) {
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second < b.second : a.first < b.first;
  });
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  column_start_.assign(static_cast<std::size_t>(size) + 1, 0);
  row_.reserve(entries.size());
  for (const auto& [row, column] : entries) {
    ++column_start_[static_cast<std::size_t>(column) + 1];
    row_.push_back(row);
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(size); ++c) column_start_[c + 1] += column_start_[c];
}

int SparsePattern::find(int row, int column) const {
  const auto begin = row_.begin() + column_start_[static_cast<std::size_t>(column)];
  const auto end = row_.begin() + column_start_[static_cast<std::size_t>(column) + 1];
  const auto place = std::lower_bound(begin, end, row);
  return place != end && *place == row ? static_cast<int>(place - row_.begin()) : -1;
}

struct SparseLU::Factors {
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  Factors() { klu_defaults(&common); }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  ~Factors() {
    if (numeric) klu_free_numeric(&numeric, &common);
    if (symbolic) klu_free_symbolic(&symbolic, &common);
  }
};

SparseLU::SparseLU(const SparsePattern& pattern) : pattern_(pattern), factors_(std::make_unique<Factors>()) {
  // KLU's interface takes pointers to non-const, and does not write through them.
  factors_->symbolic = klu_analyze(pattern.size(), const_cast<int*>(pattern.column_start().data()),
                                   const_cast<int*>(pattern.row().data()), &factors_->common);
  if (!factors_->symbolic && pattern.size() > 0) throw std::runtime_error("KLU could not analyse the matrix");
}

SparseLU::SparseLU(SparseLU&&) noexcept = default;
SparseLU::~SparseLU() = default;

FactorStatus SparseLU::factor(const std::vector<double>& values) {
  singular_column_ = -1;
  if (pattern_.size() == 0) return FactorStatus::good;
  int* starts = const_cast<int*>(pattern_.column_start().data());
  int* rows = const_cast<int*>(pattern_.row().data());
  double* entries = const_cast<double*>(values.data());
  klu_common& common = factors_->common;
  if (factors_->numeric) {
    // Old pivots serve as long as they stay large beside what they eliminate.
    constexpr double least_growth = 1e-6;
    if (klu_refactor(starts, rows, entries, factors_->symbolic, factors_->numeric, &common) &&
        common.status == KLU_OK && klu_rgrowth(starts, rows, entries, factors_->symbolic, factors_->numeric, &common) &&
        common.rgrowth > least_growth)
      return FactorStatus::good;
    klu_free_numeric(&factors_->numeric, &common);
  }
  factors_->numeric = klu_factor(starts, rows, entries, factors_->symbolic, &common);
  if (factors_->numeric && common.status == KLU_OK) return FactorStatus::good;
  singular_column_ = common.singular_col;
  if (factors_->numeric) klu_free_numeric(&factors_->numeric, &common);
  return FactorStatus::singular;
}

void SparseLU::solve(Eigen::Ref<VectorX> b) const {
  if (pattern_.size() == 0) return;
  klu_solve(factors_->symbolic, factors_->numeric, pattern_.size(), 1, b.data(), &factors_->common);
}

double SparseLU::reciprocal_condition() const {
  if (pattern_.size() == 0) return 1;
  klu_rcond(factors_->symbolic, factors_->numeric, &factors_->common);
  return factors_->common.rcond;
}

}  // namespace bielle::mechanism
