// The cells of one type of a solid, for which functions of the number of nodes are compiled. Internal to reduce/fe.
#pragma once

#include "reduce/fe/cell_geometry.hpp"
#include "reduce/fe/solid.hpp"

namespace bielle::reduce {

/// Cells of one type of a solid. It refers to the solid; its cells are counted from 0.
struct SolidBlock {
  const Solid& solid;
  CellType type;
  const Eigen::MatrixXi& nodes;  ///< (nodes of a cell, cells)
  int first;                     ///< number of its cell 0 in the solid

  Eigen::Index cells() const { return nodes.cols(); }
  int material_number(Eigen::Index cell) const { return solid.material_of[static_cast<std::size_t>(first + cell)]; }
  const Material& material(Eigen::Index cell) const {
    return solid.materials[static_cast<std::size_t>(material_number(cell))];
  }
  Eigen::Vector3d centroid(Eigen::Index cell) const {
    return solid.mesh.points(Eigen::all, nodes.col(cell)).rowwise().mean();
  }
  /// C of a cell [Pa], body axes.
  Eigen::Matrix<double, 6, 6> elasticity(Eigen::Index cell) const {
    const Material& of_cell = material(cell);
    return of_cell.is_wound() ? of_cell.elasticity_at(centroid(cell)) : of_cell.elasticity;
  }
  template <int N>
  CellPoints<N> points(Eigen::Index cell) const {
    return cell_points<N>(solid.mesh.points, nodes, cell);
  }
};

/// Calls work.operator()<N>(block) for the cells of each type, with their number of nodes.
template <class Work>
void for_each_block(const Solid& solid, const Work& work) {
  for (const SolidCells::Range& range : solid.cells.ranges()) {
    const SolidBlock block{solid, range.type, solid.cells.nodes_of(range), range.first};
    with_nodes_of(range.type, [&]<int N>() { work.template operator()<N>(block); });
  }
}

/// Calls work(cell) for every cell of a block; cells of one colour run at the same time.
template <typename Work>
void for_each_cell(const SolidBlock& block, int threads, const Work& work) {
  for (const std::vector<int>& cells : colour_cells(block.nodes, block.solid.points())) {
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t k = 0; k < cells.size(); ++k) {
      work(cells[k]);
    }
  }
}

}  // namespace bielle::reduce
