#include "mechanism/math/sparse_factors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "mechanism/math/fill_orderings.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// KLU's functions of a scalar type. Complex numbers are pairs of doubles.
template <class Scalar>
struct Klu;
template <>
struct Klu<double> {
  static constexpr auto factor = klu_factor;
  static constexpr auto refactor = klu_refactor;
  static constexpr auto solve = klu_solve;
  static constexpr auto rcond = klu_rcond;
  static constexpr auto rgrowth = klu_rgrowth;
  static constexpr auto flops = klu_flops;
  static constexpr auto free_numeric = klu_free_numeric;
};
template <>
struct Klu<std::complex<double>> {
  static constexpr auto factor = klu_z_factor;
  static constexpr auto refactor = klu_z_refactor;
  static constexpr auto solve = klu_z_solve;
  static constexpr auto rcond = klu_z_rcond;
  static constexpr auto rgrowth = klu_z_rgrowth;
  static constexpr auto flops = klu_z_flops;
  static constexpr auto free_numeric = klu_z_free_numeric;
};
double* numbers(double* values) { return values; }
double* numbers(std::complex<double>* values) { return reinterpret_cast<double*>(values); }

}  // namespace

template <class Scalar>
struct SparseFactors<Scalar>::Factors {
  klu_common common = klu_parameters();
  klu_symbolic* symbolic = nullptr;  ///< the chosen ordering, owned by the pattern
  klu_numeric* numeric = nullptr;
  double room = 0;                ///< limit of factor entries beyond which the factorisation is given up; 0: no limit
  std::vector<Scalar> scaled;     ///< R D A D, with R of the last choice of pivots
  VectorX row_size, left, right;  ///< 1/R, R D, D
  double trusted_pivots = 0;      ///< reciprocal condition number when element growth was last found harmless
  std::optional<FactorCost> known_cost;  ///< cost with these pivots
  Factors() = default;
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  ~Factors() { drop_numeric(); }
  void drop_numeric() {
    if (numeric) Klu<Scalar>::free_numeric(&numeric, &common);
    known_cost.reset();
  }
  /// Factorises `scaled` with the ordering; false if the matrix is singular, or the limit of entries is exceeded.
  bool factorise(const SparsePattern& pattern) {
    drop_numeric();
    // Without a limit the memory grows by the default factor; with one, KLU fails as soon as it would have to grow.
    common.memgrow = room > 0 ? 1e30 : klu_parameters().memgrow;
    common.initmem_amd = room > 0 ? 0.5 * room / symbolic->lnz : klu_parameters().initmem_amd;
    numeric = Klu<Scalar>::factor(klu_starts(pattern), klu_rows(pattern), numbers(scaled.data()), symbolic, &common);
    if (numeric && common.status == KLU_OK) return true;
    drop_numeric();
    if (common.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common.status == KLU_TOO_LARGE && room == 0)
      throw ComputationError("the factors of the equations have more entries than the sparse solver can count");
    return false;
  }
  bool gave_up() const { return common.status == KLU_TOO_LARGE; }
  FactorCost cost() {
    if (!known_cost) {
      Klu<Scalar>::flops(symbolic, numeric, &common);
      known_cost = {common.flops, static_cast<double>(numeric->lnz) + static_cast<double>(numeric->unz)};
    }
    return *known_cost;
  }
};

namespace {

/// Sets scaled = diag(left) A diag(right).
template <class Scalar>
void scale_entries(const SparsePattern& pattern, const std::vector<Scalar>& values, const VectorX& left,
                   const VectorX& right, std::vector<Scalar>& scaled) {
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

template <class Scalar>
SparseFactors<Scalar>::SparseFactors(const SparsePattern& pattern)
    : pattern_(pattern), factors_(std::make_unique<Factors>()) {}
template <class Scalar>
SparseFactors<Scalar>::SparseFactors(SparseFactors&&) noexcept = default;
template <class Scalar>
SparseFactors<Scalar>::~SparseFactors() = default;

template <class Scalar>
bool SparseFactors<Scalar>::refactor(const std::vector<Scalar>& values) {
  Factors& f = *factors_;
  if (!f.numeric) return false;
  f.left = f.row_size.cwiseInverse().cwiseProduct(f.right);
  scale_entries(used(), values, f.left, f.right, f.scaled);
  int *start = klu_starts(used()), *row = klu_rows(used());
  if (!Klu<Scalar>::refactor(start, row, numbers(f.scaled.data()), f.symbolic, f.numeric, &f.common) ||
      f.common.status != KLU_OK || !Klu<Scalar>::rcond(f.symbolic, f.numeric, &f.common))
    return false;
  // Element growth first shows in the pivots; it is measured if these have changed.
  constexpr double least_change = 1e-3, least_growth = 1e-6;
  const double change = f.common.rcond / f.trusted_pivots;
  if (change > least_change && change < 1 / least_change) return true;
  f.trusted_pivots = f.common.rcond;
  return Klu<Scalar>::rgrowth(start, row, numbers(f.scaled.data()), f.symbolic, f.numeric, &f.common) &&
         f.common.rgrowth > least_growth;
}

template <class Scalar>
bool SparseFactors<Scalar>::factor_afresh(const std::vector<Scalar>& values, const VectorX* row_floor) {
  Factors& f = *factors_;
  f.drop_numeric();
  const int* row = used().row().data();
  // Rows are scaled by their largest entry.
  f.row_size.setOnes(used().size());
  scale_entries(used(), values, f.right, f.right, f.scaled);
  VectorX largest = row_floor ? *row_floor : VectorX::Zero(used().size());
  for (std::size_t k = 0; k < f.scaled.size(); ++k) {
    double& size = largest[row[k]];
    size = std::max(size, std::abs(f.scaled[k]));
  }
  f.row_size = (largest.array() > 0).select(largest, f.row_size);
  f.left = f.row_size.cwiseInverse().cwiseProduct(f.right);
  scale_entries(used(), values, f.left, f.right, f.scaled);

  bool good = f.symbolic && f.factorise(used());
  if (!good && (!f.symbolic || f.gave_up())) good = choose_ordering();
  if (!good) {
    singular_column_ = f.common.singular_col;
    return false;
  }
  Klu<Scalar>::rcond(f.symbolic, f.numeric, &f.common);
  f.trusted_pivots = f.common.rcond;
  return true;
}

template <class Scalar>
bool SparseFactors<Scalar>::choose_ordering() {
  Factors& f = *factors_;
  f.symbolic = used().orderings().get(used(), FillOrderings::column_minimum_degree);
  f.room = 0;
  if (!f.factorise(used())) {
    f.symbolic = nullptr;  // a singular matrix is not representative of later ones
    return false;
  }
  try_minimum_degree();
  return true;
}

template <class Scalar>
void SparseFactors<Scalar>::try_minimum_degree() {
  Factors& f = *factors_;
  const FactorCost known = f.cost();
  Factors other;
  other.symbolic = used().orderings().get(used(), FillOrderings::minimum_degree);
  if (other.symbolic->est_flops > known.operations) return;
  other.scaled.swap(f.scaled);
  other.room = known.entries;
  const bool better = other.factorise(used()) && other.cost().operations <= known.operations;
  other.scaled.swap(f.scaled);
  if (!better) return;
  std::swap(f.symbolic, other.symbolic);
  std::swap(f.numeric, other.numeric);
  std::swap(f.known_cost, other.known_cost);
  f.room = 2 * known.entries;  // pivots of later matrices may leave the diagonal and cause more fill
}

template <class Scalar>
FactorStatus SparseFactors<Scalar>::factor(const std::vector<Scalar>& values, const VectorX& scale,
                                           const VectorX* row_floor) {
  singular_column_ = -1;
  if (pattern_.size() == 0) return FactorStatus::good;
  const std::vector<Scalar>* present = &values;
  if (!pattern_.intermittent().empty()) {
    choose_present(values);
    present_values_.resize(present_from_.size());
    for (std::size_t k = 0; k < present_from_.size(); ++k)
      present_values_[k] = values[static_cast<std::size_t>(present_from_[k])];
    present = &present_values_;
  }
  if (used().entry_count() == 0) {  // KLU accepts no matrix without entries
    singular_column_ = 0;
    return FactorStatus::singular;
  }
  factors_->right = scale;
  return refactor(*present) || factor_afresh(*present, row_floor) ? FactorStatus::good : FactorStatus::singular;
}

template <class Scalar>
void SparseFactors<Scalar>::forget() {
  factors_->drop_numeric();
  factors_->symbolic = nullptr;
  present_.reset();
  absent_.clear();
  present_intermittent_.clear();
}

/// Returns whether a range contains a nonzero value. It combines the bits of many values at a time.
template <class Scalar>
bool SparseFactors<Scalar>::any_in(const std::vector<Scalar>& values, const Range& range) {
  constexpr std::size_t parts = std::is_same_v<Scalar, double> ? 1 : 2;
  const auto* number = reinterpret_cast<const double*>(values.data());
  const std::size_t end = parts * static_cast<std::size_t>(range.end);
  std::uint64_t bits = 0;
  for (std::size_t k = parts * static_cast<std::size_t>(range.begin); k < end; ++k)
    bits |= std::bit_cast<std::uint64_t>(number[k]);
  return (bits << 1) != 0;  // the sign bit of a zero may be set
}

template <class Scalar>
void SparseFactors<Scalar>::choose_present(const std::vector<Scalar>& values) {
  const std::vector<int>& intermittent = pattern_.intermittent();
  const auto is_zero = [&](int place) { return values[static_cast<std::size_t>(place)] == Scalar(0); };
  const bool first = !present_;
  const bool grows = std::any_of(absent_.begin(), absent_.end(), [&](const Range& r) { return any_in(values, r); });
  const auto zeros = std::count_if(present_intermittent_.begin(), present_intermittent_.end(), is_zero);
  const bool stale = 2 * zeros > static_cast<long>(present_intermittent_.size()) + 10L * pattern_.size();
  if (!first && !grows && !stale) return;
  std::vector<int> kept;
  if (!first && !stale) kept = std::move(present_intermittent_);
  absent_.clear();
  present_intermittent_.clear();
  std::vector<int> start = {0}, row;
  present_from_.clear();
  std::size_t next = 0, next_kept = 0;
  const auto is_absent = [&](int place) {
    if (next == intermittent.size() || intermittent[next] != place) return false;
    ++next;
    const bool was = next_kept < kept.size() && kept[next_kept] == place;
    next_kept += was;
    if (!was && is_zero(place)) return true;
    present_intermittent_.push_back(place);
    return false;
  };
  for (int column = 0; column < pattern_.size(); ++column) {
    for (int k = pattern_.column_start()[static_cast<std::size_t>(column)];
         k < pattern_.column_start()[static_cast<std::size_t>(column) + 1]; ++k) {
      if (is_absent(k)) {
        if (absent_.empty() || absent_.back().end != k) absent_.push_back({k, k});
        absent_.back().end = k + 1;
        continue;
      }
      row.push_back(pattern_.row()[static_cast<std::size_t>(k)]);
      present_from_.push_back(k);
    }
    start.push_back(static_cast<int>(row.size()));
  }
  factors_->drop_numeric();
  factors_->symbolic = nullptr;
  present_ = std::make_unique<const SparsePattern>(std::move(start), std::move(row));
}

template <class Scalar>
void SparseFactors<Scalar>::solve(Eigen::Ref<Vector> b) const {
  if (pattern_.size() == 0) return;
  b.array() *= factors_->left.array();
  Klu<Scalar>::solve(factors_->symbolic, factors_->numeric, pattern_.size(), 1, numbers(b.data()), &factors_->common);
  b.array() *= factors_->right.array();
}

template <class Scalar>
void SparseFactors<Scalar>::solve_columns(Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& B) const {
  if (B.size() == 0) return;
  B.array().colwise() *= factors_->left.array().template cast<Scalar>();
  Klu<Scalar>::solve(factors_->symbolic, factors_->numeric, pattern_.size(), static_cast<int>(B.cols()),
                     numbers(B.data()), &factors_->common);
  B.array().colwise() *= factors_->right.array().template cast<Scalar>();
}

namespace {

/// Returns the sign of a permutation.
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

template <class Scalar>
int SparseFactors<Scalar>::determinant_sign() const requires std::is_same_v<Scalar, double> {
  if (pattern_.size() == 0) return 1;
  const Factors& f = *factors_;
  int sign = sign_of(f.numeric->Pnum, pattern_.size()) * sign_of(f.symbolic->Q, pattern_.size());
  const auto* pivots = static_cast<const double*>(f.numeric->Udiag);
  for (int k = 0; k < pattern_.size(); ++k)
    if (pivots[k] < 0) sign = -sign;
  return sign;
}

template <class Scalar>
FactorCost SparseFactors<Scalar>::cost() const {
  return factors_->numeric ? factors_->cost() : FactorCost{};
}

template <class Scalar>
double SparseFactors<Scalar>::reciprocal_condition() const {
  if (pattern_.size() == 0) return 1;
  Klu<Scalar>::rcond(factors_->symbolic, factors_->numeric, &factors_->common);
  return factors_->common.rcond;
}

template class SparseFactors<double>;
template class SparseFactors<std::complex<double>>;

}  // namespace bielle::mechanism
