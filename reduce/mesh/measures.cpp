#include "reduce/mesh/measures.hpp"

#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/solid_cells.hpp"

namespace bielle::reduce {

double mesh_volume(const Mesh& mesh) {
  const SolidCells cells(mesh);
  double volume = 0;
  for (int e = 0; e < cells.size(); ++e) volume += cell_volume(cells.type(e), cells.points(e));
  return volume;
}

}  // namespace bielle::reduce
