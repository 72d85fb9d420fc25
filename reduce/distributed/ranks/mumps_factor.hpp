// Cholesky factorisation by MUMPS of a matrix whose entries lie on all ranks; right-hand sides and solutions on rank 0.
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
  /// All ranks together.
  /// @param entries       of this rank; released when the factor is done
  /// @param block_starts  on rank 0: first unknown of each block, then `size`. Unknowns of a block have the same
  ///                      neighbours: the elimination is ordered by blocks
  /// @throws RankFailure when memory does not suffice, as far as the analysis tells before numbers are factorised, or a
  ///         pivot vanishes
  MumpsFactor(Team& team, int size, Entries entries, const std::vector<int>& block_starts);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  int size() const;
  const SharedFactorStatistics& statistics() const { return statistics_; }

  /// All ranks together. @param b  on rank 0: (size, columns), becomes the solution
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
