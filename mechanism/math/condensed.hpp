// Solution of sparse equations with dense blocks whose unknowns couple to few others: the blocks are condensed (static
// condensation) before the sparse factorisation.
//
// With a the unknowns of a block and b the others,
//     [A_aa A_ab] [x_a]   [r_a]        S = A_bb - A_ba A_aa^-1 A_ab,   S x_b = r_b - A_ba A_aa^-1 r_a,
//     [A_ba A_bb] [x_b] = [r_b],       x_a = A_aa^-1 (r_a - A_ab x_b).
// This is block elimination, exact for every matrix; it saves time because dense products run several times as fast as
// sparse elimination. The pivots of a block come from its own rows: if they are too small compared with the other rows
// (a block that is singular, or nearly, while the whole matrix is not), the whole matrix is factorised without
// condensation.
#pragma once

#include <vector>

#include "mechanism/math/sparse_factors.hpp"
#include "mechanism/math/workers.hpp"

namespace bielle::mechanism {

/// The pattern of a matrix, its blocks, and the pattern of the Schur complement after they are condensed.
class CondensedPattern {
 public:
  /// A block is condensed if this is faster: it must be dense, not too small, and couple to no other block.
  /// @param whole       pattern of the whole matrix; it must outlive this object
  /// @param candidates  unknowns of each block that may be condensed, ascending, each in one block at most
  CondensedPattern(const SparsePattern& whole, const std::vector<std::vector<int>>& candidates);
  CondensedPattern(const CondensedPattern&) = delete;
  CondensedPattern& operator=(const CondensedPattern&) = delete;

  /// Blocks with fewer unknowns are left to the sparse factorisation (measured: tests/performance/README.md).
  static constexpr int least_block = 8;

  struct Block {
    std::vector<int> inner;  ///< unknowns a of the block, ascending
    std::vector<int> outer;  ///< unknowns b that couple to the block, ascending, by their numbers in the rest
    /// Places of A_aa, A_ab and A_ba among the values of the whole matrix, by columns; -1 for an entry that is always
    /// zero.
    std::vector<int> inner_place, right_place, below_place;
    std::vector<int> rest_place;  ///< places of (outer x outer) among the values of the rest, by columns
  };
  const SparsePattern& whole() const { return *whole_; }
  const SparsePattern& rest() const { return rest_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<int>& kept() const { return kept_; }  ///< numbers in the whole matrix of the unknowns of the rest
  const std::vector<int>& rest_from() const {
    return rest_from_;
  }  ///< place in the whole matrix of each entry of the rest, or -1

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

/// LU factors of a matrix with such a pattern, condensed block by block. The class has the same interface as SparseLU.
class CondensedLU {
 public:
  explicit CondensedLU(const CondensedPattern& pattern);  ///< the pattern must outlive the factors
  CondensedLU(CondensedLU&&) noexcept;
  ~CondensedLU();

  /// Factorises D A D with a diagonal D, which must be 1 for the unknowns of blocks.
  /// @param values  values of A, in the order of the whole pattern
  /// @param workers  they condense blocks in parallel; results do not depend on them
  FactorStatus factor(const std::vector<double>& values, const VectorX& scale, Workers& workers);
  void forget();
  /// b <- A^-1 b. Call it only after a successful factorisation, and from one thread at a time.
  void solve(Eigen::Ref<VectorX> b) const;
  /// Column (an unknown of the whole matrix) at which the last factorisation found no pivot, or -1.
  int singular_column() const;
  int determinant_sign() const;
  double reciprocal_condition() const;
  FactorCost cost() const;  ///< cost of the last successful factorisation
  /// Returns whether the blocks are condensed in the last factors.
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
