// Cholesky factorisation by MUMPS of a matrix whose entries are distributed over all ranks; right-hand sides and
// solutions are on rank 0.
//
// P. R. Amestoy, I. S. Duff, J. Koster, J.-Y. L'Excellent, SIAM J. Matrix Anal. Appl. 23 (2001) 15.
#pragma once

#include <memory>
#include <vector>

#include "reduce/distributed/ranks/part.hpp"
#include "reduce/distributed/ranks/team.hpp"

namespace bielle::reduce {

class MumpsFactor {
 public:
  /// Called by all ranks together.
  /// @param entries       entries on this rank; released when the factor is complete
  /// @param block_starts  on rank 0: first unknown of each block, then `size`. Unknowns of a block have the same
  ///                      neighbours: the elimination is ordered by blocks
  /// @throws RankFailure if memory does not suffice, as far as the analysis predicts before the numerical
  ///         factorisation, or if a pivot vanishes
  MumpsFactor(Team& team, int size, Entries entries, const std::vector<int>& block_starts);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  int size() const;
  const SharedFactorStatistics& statistics() const { return statistics_; }

  /// Called by all ranks together. @param b  on rank 0: (size, columns), becomes the solution
  void solve(double* b, int columns);

 private:
  struct Instance;
  void analyse(const std::vector<int>& block_starts);
  void check_memory();
  void factorise();
  Team& team_;
  std::unique_ptr<Instance> instance_;
  SharedFactorStatistics statistics_;
};

}  // namespace bielle::reduce
