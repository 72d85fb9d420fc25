#include "reduce/distributed/ranks/part.hpp"

#include <algorithm>
#include <utility>

#include "reduce/fe/assembly.hpp"
#include "reduce/fe/geometric_stiffness.hpp"

namespace bielle::reduce {

namespace {

Mesh mesh_of(MeshShare& share) {
  Mesh mesh;
  mesh.points = std::move(share.points);
  mesh.blocks = std::move(share.blocks);
  return mesh;
}

/// The unknowns that determine a row of u, with their weights.
struct Followed {
  const int* unknowns;
  const double* weights;
  int count;
};

constexpr double one = 1;

Followed followed(const InteriorShare& share, std::int64_t row) {
  const auto k = static_cast<std::size_t>(row);
  if (share.numbers[k] >= 0) return {&share.numbers[k], &one, 1};
  return {share.unknowns.data() + share.starts[k], share.weights.data() + share.starts[k],
          share.starts[k + 1] - share.starts[k]};
}

}  // namespace

void Entries::add(int row, int column, double value) {
  rows.push_back(std::max(row, column) + 1);
  columns.push_back(std::min(row, column) + 1);
  values.push_back(value);
}

Part::Part(MeshShare share, int threads)
    : threads_(threads),
      mesh_(mesh_of(share)),
      solid_{mesh_,
             SolidCells(mesh_),
             std::move(share.materials),
             std::move(share.material_of),
             share.integration,
             std::move(share.coatings),
             share.lumped},
      graph_(node_graph(mesh_, threads)),
      stiffness_(assemble_stiffness(solid_, graph_, threads)),
      mass_(assemble_mass(solid_, graph_, threads)) {}

std::vector<Eigen::MatrixXd> Part::geometric_stiffness(const RowMatrix& fields, const RowMatrix& shapes) const {
  return reduced_geometric_stiffness(solid_, graph_, fields, shapes, threads_);
}

Entries Part::interior(const InteriorShare& share) const {
  Entries entries;
  const auto most = stiffness_.values.size();
  entries.rows.reserve(most);
  entries.columns.reserve(most);
  entries.values.reserve(most);
  for (std::int64_t j = 0; j < stiffness_.size; ++j) {
    const Followed by_column = followed(share, j);
    if (by_column.count == 0) continue;
    for (std::int64_t p = stiffness_.starts[j]; p < stiffness_.starts[j + 1]; ++p) {
      const std::int64_t i = stiffness_.rows[p];
      const Followed by_row = followed(share, i);
      for (int a = 0; a < by_row.count; ++a) {
        for (int b = 0; b < by_column.count; ++b) {
          const int row = by_row.unknowns[a], column = by_column.unknowns[b];
          if (i == j && row < column) continue;  // the loops meet the pair in the other order, too
          // (i,j) stands for (j,i) as well; if both become one entry of the diagonal, it counts twice.
          const double twice = i != j && row == column ? 2 : 1;
          entries.add(row, column, twice * by_row.weights[a] * by_column.weights[b] * stiffness_.values[p]);
        }
      }
    }
  }
  return entries;
}

}  // namespace bielle::reduce
