// The update matrix of a supernode that is added to the front of its parent: the extend-add of multifrontal methods.
#pragma once

#include <cstdint>
#include <vector>

#include "reduce/spectral/front.hpp"
#include "reduce/spectral/supernodal_solver.hpp"

namespace bielle {

/// Supernode s of a structure.
struct SupernodeShape {
  std::int64_t first, width, rows;
  const std::int64_t* row_numbers;

  SupernodeShape(const SupernodalFactor& structure, std::int64_t s)
      : first(structure.columns[s]),
        width(structure.columns[s + 1] - first),
        rows(structure.row_starts[s + 1] - structure.row_starts[s]),
        row_numbers(structure.rows + structure.row_starts[s]) {}
  std::int64_t below() const { return rows - width; }
};

/// Where the rows of an update matrix stand in the parent.
class ChildUpdate {
 public:
  ChildUpdate(const double* update, const SupernodeShape& child, const SupernodeShape& parent);

  /// Adds what belongs to columns first .. end of the parent.
  void add_to(const Front& to, std::int64_t first, std::int64_t end) const;

 private:
  /// Rows of a child that follow each other in its parent as well.
  struct Run {
    std::int64_t begin, end;  // rows below the child
    std::int64_t shift;       // of the place in the parent
  };
  static std::vector<Run> runs_of(const std::vector<std::int64_t>& places);

  const double* update_;
  UpdatePanels panels_;
  std::vector<std::int64_t> places_;
  std::vector<Run> runs_;
};

}  // namespace bielle
