#include "mechanism/math/sparse.hpp"

#include <algorithm>
#include <cmath>
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
  std::vector<double> scaled;     ///< R D A D, R of the last choice of pivots
  VectorX row_size, left, right;  ///< 1/R, R D, D
  double trusted_pivots = 0;      ///< reciprocal condition when growth was last found harmless
  Factors() {
    klu_defaults(&common);
    common.scale = -1;  // done here
    common.btf = 0;     // permuting constraint rows off the diagonal costs more fill than blocks save
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  ~Factors() { drop(); }
  void drop_numeric() {
    if (numeric) klu_free_numeric(&numeric, &common);
  }
  void drop() {
    drop_numeric();
    if (symbolic) klu_free_symbolic(&symbolic, &common);
  }
};

namespace {

// KLU's interface takes pointers to non-const, and does not write through them.
int* starts(const SparsePattern& pattern) { return const_cast<int*>(pattern.column_start().data()); }
int* rows(const SparsePattern& pattern) { return const_cast<int*>(pattern.row().data()); }

/// scaled = diag(left) A diag(right)
void scale_entries(const SparsePattern& pattern, const std::vector<double>& values, const VectorX& left,
                   const VectorX& right, std::vector<double>& scaled) {
  scaled.resize(values.size());
  const int* row = pattern.row().data();
  for (int column = 0; column < pattern.size(); ++column) {
    const double factor = right[column];
    const int end = pattern.column_start()[static_cast<std::size_t>(column) + 1];
    for (int k = pattern.column_start()[static_cast<std::size_t>(column)]; k < end; ++k)
      scaled[static_cast<std::size_t>(k)] = values[static_cast<std::size_t>(k)] * (factor * left[row[k]]);
  }
}

}  // namespace

SparseLU::SparseLU(const SparsePattern& pattern) : pattern_(pattern), factors_(std::make_unique<Factors>()) {}
SparseLU::SparseLU(SparseLU&&) noexcept = default;
SparseLU::~SparseLU() = default;

bool SparseLU::refactor(const std::vector<double>& values) {
  Factors& f = *factors_;
  if (!f.numeric) return false;
  f.left = f.row_size.cwiseInverse().cwiseProduct(f.right);
  scale_entries(pattern_, values, f.left, f.right, f.scaled);
  int *start = starts(pattern_), *row = rows(pattern_);
  if (!klu_refactor(start, row, f.scaled.data(), f.symbolic, f.numeric, &f.common) || f.common.status != KLU_OK ||
      !klu_rcond(f.symbolic, f.numeric, &f.common))
    return false;
  // Growth of the elements shows in the pivots first; it is measured where these have changed.
  constexpr double least_change = 1e-3, least_growth = 1e-6;
  const double change = f.common.rcond / f.trusted_pivots;
  if (change > least_change && change < 1 / least_change) return true;
  f.trusted_pivots = f.common.rcond;
  return klu_rgrowth(start, row, f.scaled.data(), f.symbolic, f.numeric, &f.common) && f.common.rgrowth > least_growth;
}

bool SparseLU::factor_afresh(const std::vector<double>& values) {
  Factors& f = *factors_;
  f.drop_numeric();
  int *start = starts(pattern_), *row = rows(pattern_);
  // Rows by their largest entry.
  f.row_size.setOnes(pattern_.size());
  scale_entries(pattern_, values, f.right, f.right, f.scaled);
  VectorX largest = VectorX::Zero(pattern_.size());
  for (std::size_t k = 0; k < f.scaled.size(); ++k) {
    double& size = largest[row[k]];
    size = std::max(size, std::abs(f.scaled[k]));
  }
  f.row_size = (largest.array() > 0).select(largest, f.row_size);
  f.left = f.row_size.cwiseInverse().cwiseProduct(f.right);
  scale_entries(pattern_, values, f.left, f.right, f.scaled);

  const auto factorise = [&] {
    f.numeric = klu_factor(start, row, f.scaled.data(), f.symbolic, &f.common);
    if (f.numeric && f.common.status == KLU_OK) return true;
    singular_column_ = f.common.singular_col;
    f.drop_numeric();
    return false;
  };
  if (f.symbolic) {
    if (!factorise()) return false;
  } else if (!choose_ordering(factorise)) {
    return false;
  }
  singular_column_ = -1;
  klu_rcond(f.symbolic, f.numeric, &f.common);
  f.trusted_pivots = f.common.rcond;
  return true;
}

bool SparseLU::choose_ordering(const std::function<bool()>& factorise) {
  Factors& f = *factors_;
  constexpr int minimum_degree = 0, column_minimum_degree = 1;
  klu_symbolic* best_symbolic = nullptr;
  klu_numeric* best_numeric = nullptr;
  double least_operations = 0;
  for (const int ordering : {minimum_degree, column_minimum_degree}) {
    f.common.ordering = ordering;
    f.symbolic = klu_analyze(pattern_.size(), starts(pattern_), rows(pattern_), &f.common);
    if (!f.symbolic) throw std::runtime_error("KLU could not analyse the matrix");
    if (!factorise()) {
      f.drop();
      continue;
    }
    klu_flops(f.symbolic, f.numeric, &f.common);
    if (!best_numeric || f.common.flops < least_operations) {
      std::swap(f.symbolic, best_symbolic);
      std::swap(f.numeric, best_numeric);
      least_operations = f.common.flops;
    }
    f.drop();
  }
  f.symbolic = best_symbolic;
  f.numeric = best_numeric;
  return f.numeric != nullptr;
}

FactorStatus SparseLU::factor(const std::vector<double>& values, const VectorX& scale) {
  singular_column_ = -1;
  if (pattern_.size() == 0) return FactorStatus::good;
  if (pattern_.entry_count() == 0) {  // KLU takes no matrix without entries
    singular_column_ = 0;
    return FactorStatus::singular;
  }
  factors_->right = scale;
  return refactor(values) || factor_afresh(values) ? FactorStatus::good : FactorStatus::singular;
}

void SparseLU::forget() { factors_->drop(); }

void SparseLU::solve(Eigen::Ref<VectorX> b) const {
  if (pattern_.size() == 0) return;
  b.array() *= factors_->left.array();
  klu_solve(factors_->symbolic, factors_->numeric, pattern_.size(), 1, b.data(), &factors_->common);
  b.array() *= factors_->right.array();
}

namespace {

/// Sign of a permutation.
int sign_of(const int* permutation, int size) {
  std::vector<bool> seen(static_cast<std::size_t>(size), false);
  int sign = 1;
  for (int begin = 0; begin < size; ++begin) {
    int length = 0;
    for (int k = begin; !seen[static_cast<std::size_t>(k)]; k = permutation[k], ++length)
      seen[static_cast<std::size_t>(k)] = true;
    if (length > 0 && length % 2 == 0) sign = -sign;
  }
  return sign;
}

}  // namespace

int SparseLU::determinant_sign() const {
  if (pattern_.size() == 0) return 1;
  const Factors& f = *factors_;
  int sign = sign_of(f.numeric->Pnum, pattern_.size()) * sign_of(f.symbolic->Q, pattern_.size());
  const auto* pivots = static_cast<const double*>(f.numeric->Udiag);
  for (int k = 0; k < pattern_.size(); ++k)
    if (pivots[k] < 0) sign = -sign;
  return sign;
}

double SparseLU::reciprocal_condition() const {
  if (pattern_.size() == 0) return 1;
  klu_rcond(factors_->symbolic, factors_->numeric, &factors_->common);
  return factors_->common.rcond;
}

}  // namespace bielle::mechanism
