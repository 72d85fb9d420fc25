// Factorisation of sparse matrices with a fixed pattern by KLU, whose symbolic analysis is reused.
#pragma once

#include <complex>
#include <memory>
#include <type_traits>
#include <vector>

#include "mechanism/math/sparse_pattern.hpp"
#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

enum class FactorStatus { good, singular };

/// Cost of a factorisation.
struct FactorCost {
  double operations = 0;        ///< operations of one sparse factorisation with known pivots
  double entries = 0;           ///< number of entries of both sparse factors
  double dense_operations = 0;  ///< operations that condense dense blocks
  double dense_entries = 0;     ///< number of entries of the factors of these blocks and of what couples them
};

/// LU factors of a sparse unsymmetric matrix, real or complex (KLU with partial pivoting).
///
/// The fill-reducing ordering is chosen for the first matrix. Column minimum degree (COLAMD) bounds the fill for any
/// choice of pivot rows. Minimum degree (AMD) needs fewer operations if pivots stay on the diagonal, but may need many
/// more if they leave it, as constraints require: a thousand times as many for kinematic loops. AMD is tried if its
/// estimate, which ignores pivoting, promises fewer operations; it is rejected as soon as its factors need as much
/// memory as those of COLAMD, and kept if it has needed fewer operations. Therefore the choice depends only on this
/// matrix, not on earlier ones.
///
/// `factor` keeps the pivot sequence as long as its pivots do not degenerate. When pivots are chosen, rows are scaled
/// to a largest entry of one, for any units.
///
/// If the pattern has intermittent entries, only those are factorised that are not zero now or were not zero before,
/// until these are many: a new entry requires a new ordering and new pivots.
template <class Scalar>
class SparseFactors {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  explicit SparseFactors(const SparsePattern& pattern);  ///< the pattern must outlive the factors
  SparseFactors(SparseFactors&&) noexcept;
  ~SparseFactors();

  /// Factorises D A D with a diagonal D.
  /// @param values  values of A, in the order of the pattern
  /// @param scale   the diagonal of D (size)
  /// @param row_floor  largest entries of the rows of D A D before cancellation, if the rows are remainders of larger
  ///                   ones (size). Rows that have cancelled then stay small, and so do their pivots
  FactorStatus factor(const std::vector<Scalar>& values, const VectorX& scale, const VectorX* row_floor = nullptr);
  /// Discards ordering and pivots: the next factorisation chooses them again.
  void forget();
  /// b <- A^-1 b. Call it only after a successful factorisation.
  void solve(Eigen::Ref<Vector> b) const;
  /// B <- A^-1 B for several columns, which takes less time than one by one.
  void solve_columns(Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& B) const;
  /// Column (an unknown) at which the last factorisation found no pivot, or -1.
  int singular_column() const { return singular_column_; }
  /// Sign of the determinant of the last factorised matrix: -1 or 1. Its rows must be scaled by positive numbers.
  int determinant_sign() const requires std::is_same_v<Scalar, double>;
  FactorCost cost() const;  ///< cost of the last successful factorisation
  /// Cheap estimate of the reciprocal condition number of the scaled matrix: ratio of smallest to largest pivot.
  double reciprocal_condition() const;

 private:
  struct Factors;
  bool refactor(const std::vector<Scalar>& values);  ///< uses the previous pivots; false if they fail
  bool factor_afresh(const std::vector<Scalar>& values, const VectorX* row_floor);  ///< false if the matrix is singular
  bool choose_ordering();
  void try_minimum_degree();
  /// A range of consecutive places.
  struct Range {
    int begin, end;
  };
  static bool any_in(const std::vector<Scalar>& values, const Range& range);
  void choose_present(const std::vector<Scalar>& values);
  const SparsePattern& used() const { return present_ ? *present_ : pattern_; }
  const SparsePattern& pattern_;
  std::unique_ptr<const SparsePattern>
      present_;                            ///< entries of a pattern with intermittent entries that are factorised
  std::vector<int> present_from_;          ///< their places in the whole pattern
  std::vector<int> present_intermittent_;  ///< places of the intermittent entries among them, ascending
  std::vector<Range> absent_;              ///< places of the entries that are not factorised
  std::vector<Scalar> present_values_;
  std::unique_ptr<Factors> factors_;
  int singular_column_ = -1;
};

using SparseLU = SparseFactors<double>;
using ComplexSparseLU = SparseFactors<std::complex<double>>;
extern template class SparseFactors<double>;
extern template class SparseFactors<std::complex<double>>;

}  // namespace bielle::mechanism
