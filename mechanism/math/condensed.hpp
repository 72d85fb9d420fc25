// Sparse equations with dense blocks whose unknowns couple to few others: these are condensed (static condensation)
// before the sparse factorisation.
//
// With a the unknowns of a block and b the others,
//     [A_aa A_ab] [x_a]   [r_a]        S = A_bb - A_ba A_aa^-1 A_ab,   S x_b = r_b - A_ba A_aa^-1 r_a,
//     [A_ba A_bb] [x_b] = [r_b],       x_a = A_aa^-1 (r_a - A_ab x_b).
// It is block elimination, exact whatever the matrix, and worth it because dense products run several times as fast as
// sparse elimination. Pivots of a block come from its own rows: where they are too small for the others (a block that
// is singular, or nearly, while the whole is not), the whole matrix is factorised as it is.
#pragma once

#include <vector>

#include "mechanism/math/sparse.hpp"
#include "mechanism/math/workers.hpp"

namespace bielle::mechanism {

/// The pattern of a matrix, its blocks, and the pattern of what is left of it when they are condensed.
class CondensedPattern {
 public:
  /// Blocks are condensed where that is faster: they are dense, not too small, and couple to no other block.
  /// @param whole       must outlive this
  /// @param candidates  unknowns of each block that may be condensed, ascending, each in one block at most
  CondensedPattern(const SparsePattern& whole, const std::vector<std::vector<int>>& candidates);
  CondensedPattern(const CondensedPattern&) = delete;
  CondensedPattern& operator=(const CondensedPattern&) = delete;

  /// Fewer unknowns than this are left to the sparse factorisation (measured: tests/performance/README.md).
  static constexpr int least_block = 8;

  struct Block {
    std::vector<int> inner;  ///< its unknowns a, ascending
    std::vector<int> outer;  ///< those that it couples to, ascending, by their numbers among the rest
    /// Places of A_aa, A_ab and A_ba among the values of the whole, by columns; -1 where an entry is always zero.
    std::vector<int> inner_place, right_place, below_place;
    std::vector<int> rest_place;  ///< of (outer x outer) among the values of the rest, by columns
  };
  const SparsePattern& whole() const { return *whole_; }
  const SparsePattern& rest() const { return rest_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<int>& kept() const { return kept_; }  ///< unknowns of the rest by their numbers in the whole
  const std::vector<int>& rest_from() const {
    return rest_from_;
  }  ///< place in the whole of each entry of the rest, or -1

 private:
  void choose_blocks(const std::vector<std::vector<int>>& candidates);
  bool add_block(const std::vector<int>& inner, const SparsePattern& rows, std::vector<char>& taken);
  void build_rest();
  void find_places(Block& block) const;

  const SparsePattern* whole_;
  std::vector<Block> blocks_;
  std::vector<int> kept_, number_in_rest_, rest_from_;
  SparsePattern rest_;
};

/// LU factors of a matrix with such a pattern. Takes the place of SparseLU, see there.
class CondensedLU {
 public:
  explicit CondensedLU(const CondensedPattern& pattern);  ///< which must outlive the factors
  CondensedLU(CondensedLU&&) noexcept;
  ~CondensedLU();

  /// Factorises D A D with a diagonal D, which is 1 for the unknowns of blocks.
  /// @param values  of A, in the order of the whole pattern
  /// @param workers  condense blocks at the same time; results do not depend on them
  FactorStatus factor(const std::vector<double>& values, const VectorX& scale, Workers& workers);
  void forget();
  /// b <- A^-1 b. Only after a good factorisation; by one thread at a time.
  void solve(Eigen::Ref<VectorX> b) const;
  /// Column (an unknown of the whole) at which the last factorisation found no pivot, or -1.
  int singular_column() const;
  int determinant_sign() const;
  double reciprocal_condition() const;
  /// Whether the last factors are of condensed blocks.
  bool condensed() const { return condensed_; }

 private:
  struct Block;
  bool condense(const std::vector<double>& values, const VectorX& scale, Workers& workers);

  const CondensedPattern& pattern_;
  SparseLU whole_, rest_;
  std::vector<Block> blocks_;
  std::vector<double> rest_values_;
  VectorX rest_scale_, row_floor_;
  mutable VectorX rest_vector_;
  bool condensed_ = false;
};

}  // namespace bielle::mechanism
