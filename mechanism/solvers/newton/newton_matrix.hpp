// One linear solution of Newton's method: scaled tangent, factorisation, and messages for singular matrices.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Solves J delta = -r with the rows and columns of multipliers scaled by a number k of the size of the tangent's
/// diagonal, so that the conditioning depends on neither the step nor the units (Bottasso, Bauchau and Cardona, IJNME
/// 69 (2007) 498; Bruls, Cardona and Arnold 2012). The resulting multipliers are physical.
///
/// Amplitudes that couple only to their own component's unknowns are condensed if this is faster (condensed.hpp).
///
/// Columns of algebraic unknowns contain K for any weights: while other unknowns are represented by their rates (a
/// consistent start), algebraic ones are unknown themselves.
class NewtonMatrix {
 public:
  explicit NewtonMatrix(const System& system);

  /// Assembles and factorises the tangent. @throws ComputationError naming the unknown without stiffness, mass or
  /// constraint
  void factor(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq);
  /// Only assembles the tangent, its scale and its row sums.
  void assemble(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq,
                const VectorX* extra = nullptr);
  const TangentWeights& weights() const { return weights_; }     ///< weights of the last tangent
  const std::vector<double>& values() const { return values_; }  ///< last tangent, in the order of `pattern`
  /// Pattern of the last tangent: that of the system then.
  const std::shared_ptr<const TangentPattern>& pattern() const { return pattern_; }
  /// Does the same as `factor`, with `extra` added to the diagonal of the dofs; returns false if the matrix is
  /// singular.
  bool try_factor(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq,
                  const VectorX* extra = nullptr);
  /// Discards the pivots: the next factorisation chooses new ones.
  void choose_pivots_anew() { factors_.reset(); }
  /// delta = -J^-1 r. @param r,delta (size)
  void solve(const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) const;

  /// Returns whether the last factors have a pivot that is only rounding. The factors must exist.
  bool nearly_singular() const;
  /// Unknown at which the last factorisation found no pivot, or -1.
  int singular_unknown() const { return factors_->singular_column(); }
  /// Cost of the last successful factorisation.
  FactorCost factor_cost() const { return factors_ ? factors_->cost() : FactorCost{}; }
  double scale() const { return scale_; }                                ///< k
  int determinant_sign() const { return factors_->determinant_sign(); }  ///< for the last (scaled) tangent
  /// Computes the sums over columns |J_ij| s_j of the last (unscaled) tangent: the effect of rounding of the unknowns
  /// on equation i.
  void row_sums(const Eigen::Ref<const VectorX>& unknown_scale, Eigen::Ref<VectorX> sums) const;
  /// Diagonal of the last (unscaled) tangent.
  double diagonal(int unknown) const;
  [[noreturn]] void throw_singular(double time) const;

 private:
  void take_pattern();
  void take_algebraic_columns();

  const System& system_;
  std::shared_ptr<const TangentPattern> pattern_, factored_pattern_;  ///< those of the tangent and of the factors
  std::optional<CondensedLU> factors_;
  std::vector<double> values_, stiffness_;
  TangentWeights weights_;
  std::vector<int> diagonal_;  ///< places of the diagonal among the values, -1 where absent
  /// The scale is that of translations; without translations, that of rotations; and so on.
  static constexpr std::array scaling_kinds{Kind::translation, Kind::rotation, Kind::amplitude};
  std::array<std::vector<int>, scaling_kinds.size()> diagonal_by_kind_;  ///< their existing places
  VectorX scales_;  ///< 1 for dofs and first-order unknowns, k for multipliers
  double scale_ = 1;
};

}  // namespace bielle::mechanism
