// The numerical part of a sparse factorisation, by the multifrontal method, on a structure of supernodes.
//
// A supernode with the rows r takes up the entries of A in its own columns and the update matrices of its children,
// eliminates its own columns, L11 L11^T = A11, L21 = A21 L11^-T, and leaves its parent the update matrix
// U = (what its children gave) - L21 L21^T. All of it is products of dense matrices. Threads take subtrees of the
// elimination tree, each with a BLAS of one thread; what is above these they eliminate together, a part of the rows of
// each supernode each. Every number is the sum of the same terms in the same order, whatever the threads do.
// Reference: I. S. Duff, J. K. Reid, ACM Trans. Math. Software 9 (1983) 302; J. W. H. Liu, SIAM Review 34 (1992) 82.
//
// The same with A = L D L^T, D diagonal, counts the negative entries of D, which are as many as the negative
// eigenvalues of A (Sylvester). No rows are interchanged: L may grow where A is indefinite, and how far it did is told.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reduce/spectral/bordered_part.hpp"
#include "reduce/spectral/elimination_tree.hpp"
#include "reduce/spectral/supernodal_solver.hpp"
#include "reduce/spectral/symmetric_factor.hpp"
#include "reduce/spectral/symmetric_matrix.hpp"
#include "reduce/spectral/update_matrices.hpp"

namespace bielle {

class Multifrontal {
 public:
  /// @param structure  values are not read; it outlives this
  Multifrontal(const SupernodalFactor& structure, int threads);

  /// Of the memory that it takes in addition to L [bytes].
  double working_bytes() const;

  /// L of A = L L^T, where the structure says.
  /// @param a  with the pattern that the structure was made for, or part of it
  /// @param values  zero so far
  /// @returns  the column of L where a pivot was not positive; nothing when all were
  /// @throws std::bad_alloc
  std::optional<std::int64_t> factorise(const BorderedPart& a, double* values) const;

  /// Signs of the pivots of A = L D L^T; neither L nor A is kept.
  /// @param scale  positive, of each unknown
  /// @throws std::bad_alloc
  PivotSigns count_signs(SymmetricMatrix a, const std::vector<double>& scale) const;

 private:
  int workers() const;  // threads that eliminate subtrees

  const SupernodalFactor& structure_;
  int threads_;
  EliminationTree tree_;
  UpdatePlan plan_;
};

}  // namespace bielle
