// The matrices of one rank's cells, and their projection on the unknowns of the interior.
#pragma once

#include <vector>

#include "reduce/distributed/shares.hpp"
#include "reduce/fe/node_graph.hpp"
#include "reduce/fe/solid.hpp"

namespace bielle::reduce {

/// Entries of a symmetric matrix, one of each pair (i,j), (j,i); repeated entries, here and on other ranks, are added.
/// Numbers start at 1, as in MUMPS.
struct Entries {
  std::vector<int> rows, columns;
  std::vector<double> values;

  void add(int row, int column, double value);
};

class Part {
 public:
  /// @param share    unpacked; taken
  /// @param threads  number of threads for assembly and products
  /// @throws ComputationError as assemble_stiffness
  Part(MeshShare share, int threads);
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  /// K u, and (m (x) I) u, for rows of this part's points.
  RowMatrix stiffness_times(const RowMatrix& u) const { return stiffness_.multiply(u, threads_); }
  RowMatrix mass_times(const RowMatrix& u, int rows_per_node) const {
    return mass_.multiply(u, rows_per_node, threads_);
  }
  Eigen::VectorXd stiffness_diagonal() const { return stiffness_.diagonal(); }
  std::vector<Eigen::MatrixXd> geometric_stiffness(const RowMatrix& fields, const RowMatrix& shapes) const;

  /// P^T K P of this part.
  Entries interior(const InteriorShare& share) const;

 private:
  int threads_;
  Mesh mesh_;
  Solid solid_;
  NodeGraph graph_;
  SymmetricMatrix stiffness_;
  NodeMatrix mass_;
};

}  // namespace bielle::reduce
