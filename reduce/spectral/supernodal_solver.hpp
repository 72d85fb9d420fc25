// Solutions with a supernodal Cholesky factor, many columns at once.
//
// Solutions are bound by memory. Here every thread reads its own part of the factor, once forwards and once backwards
// for all columns: it takes some subtrees of the elimination tree, which do not touch each other, and adds what these
// give to the supernodes above them into rows of its own. The supernodes above are shared out row by row. The factor is
// rearranged once, into panels of a few rows, so that each value is read in the order in which it stands in memory.
// (CHOLMOD's own solution, with some of the columns in each thread, makes each of them read the whole factor.)
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <Eigen/Core>

namespace bielle {

/// P A P^T = L L^T as CHOLMOD stores it, owned by somebody else. Supernode s has the columns
/// `columns[s] .. columns[s+1]` of L and the rows `rows[row_starts[s] .. row_starts[s+1])`, its own first; its values
/// are a dense matrix by columns from `values[value_starts[s]]` on, the upper triangle of its own columns being of no
/// meaning.
struct SupernodalFactor {
  std::int64_t size = 0, supernodes = 0;
  const std::int64_t *columns = nullptr, *row_starts = nullptr, *value_starts = nullptr, *rows = nullptr;
  const std::int64_t* order = nullptr;  ///< row k of L belongs to unknown order[k]
  const double* values = nullptr;
};

struct EliminationTree;
struct TreeShares;

class SupernodalSolver {
 public:
  /// @param factor  outlives this
  /// @param values  of the factor: they are rearranged for solutions, and of no use to anybody else afterwards
  /// @throws std::bad_alloc
  SupernodalSolver(const SupernodalFactor& factor, double* values, int threads);
  ~SupernodalSolver();

  /// x = A^-1 b, by columns of any number. The same for the same number of threads. @throws std::bad_alloc
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  class Sweep;
  struct Room;

  void share_out(int threads);
  void give_subtrees(const EliminationTree& tree, const TreeShares& shares, const std::vector<double>& entries);
  void number_rows_above(const TreeShares& shares);
  void cut_into_panels(double* values) const;
  std::unique_ptr<Room> take_room(int columns) const;
  void keep(std::unique_ptr<Room> room) const;

  SupernodalFactor factor_;
  std::vector<std::int64_t> places_;                   // the row of L of each unknown
  std::vector<std::vector<std::int64_t>> of_threads_;  // supernodes of the subtrees of each thread, ascending
  std::vector<std::int64_t> above_;                    // the others, ascending
  std::vector<std::int64_t> place_above_;              // of each row of L in the rows of `above_`; -1: in a subtree
  std::vector<std::int64_t> unknowns_above_;           // rows of L of `above_`
  std::int64_t rows_above_ = 0;
  mutable std::mutex guard_;
  mutable std::unique_ptr<Room> kept_;  // of the last solution: fresh memory would take time to clear
};

}  // namespace bielle
