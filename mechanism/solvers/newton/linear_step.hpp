// One linear solve of Newton's method: scaled tangent, factorisation, and what to say when it is singular.
#pragma once

#include <array>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Solves J delta = -r with the rows and columns of multipliers scaled by a number k of the size of the tangent's
/// diagonal, so that the conditioning depends on neither the step nor the units (Bottasso, Bauchau and Cardona, IJNME
/// 69 (2007) 498; Bruls, Cardona and Arnold 2012). The multipliers that come back are physical.
///
/// Amplitudes that couple to their own component's unknowns alone are condensed where that is faster (condensed.hpp).
///
/// Columns of algebraic unknowns hold K whatever the weights: where others are represented by their rates (a consistent
/// start), these are unknown themselves.
class LinearStep {
 public:
  explicit LinearStep(const System& system);

  /// Assembles and factorises. @throws ComputationError naming the unknown without stiffness, mass or constraint
  void factor(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq);
  /// Assembles alone: the tangent, its scale and its row sums.
  void assemble(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq,
                const VectorX* extra = nullptr);
  const TangentWeights& weights() const { return weights_; }     ///< of the last tangent
  const std::vector<double>& values() const { return values_; }  ///< of the last tangent, in the system's pattern
  /// As `factor`, with `extra` added to the diagonal of the dofs; returns false when singular.
  bool try_factor(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq,
                  const VectorX* extra = nullptr);
  /// The next factorisation owes nothing to those before.
  void choose_pivots_anew() { factors_.forget(); }
  /// delta = -J^-1 r. @param r,delta (size)
  void solve(const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) const;

  /// Whether the last factors hold a pivot that is made of rounding errors. They must exist.
  bool nearly_singular() const;
  /// Where the last factorisation found no pivot, or -1.
  int singular_unknown() const { return factors_.singular_column(); }
  double scale() const { return scale_; }                               ///< k
  int determinant_sign() const { return factors_.determinant_sign(); }  ///< of the last (scaled) tangent
  /// Sum over columns |J_ij| s_j of the last (unscaled) tangent: what rounding of the unknowns does to equation i.
  void row_sums(const Eigen::Ref<const VectorX>& unknown_scale, Eigen::Ref<VectorX> sums) const;
  /// Diagonal of the last (unscaled) tangent.
  double diagonal(int unknown) const;
  [[noreturn]] void throw_singular(double time) const;

 private:
  void take_algebraic_columns(const State& state, const Environment& environment);

  const System& system_;
  CondensedLU factors_;
  std::vector<double> values_, stiffness_;
  TangentWeights weights_;
  std::vector<int> diagonal_;  ///< places of the diagonal among the values, -1 where absent
  /// The scale is of translations; of a system that only turns, of its rotations; and so on.
  static constexpr std::array scaling_kinds{Kind::translation, Kind::rotation, Kind::amplitude};
  std::array<std::vector<int>, scaling_kinds.size()> diagonal_by_kind_;  ///< their places that exist
  VectorX scales_;  ///< 1 for dofs and first-order unknowns, k for multipliers
  double scale_ = 1;
};

}  // namespace bielle::mechanism
