#include "reduce/reduction/integration_checks.hpp"

#include <algorithm>

#include "reduce/common/error.hpp"
#include "reduce/fe/assembly.hpp"

namespace bielle::reduce {

void check_integration(const Mesh& mesh, Integration integration) {
  const auto has = [&](CellType type) { return mesh.block(type) != nullptr; };
  if (integration == Integration::reduced && !has(CellType::hex20))
    throw InputError("integration", "'reduced' concerns hexahedra with 20 nodes, and the mesh has none");
  if (integration == Integration::plain && !has(CellType::hex8) && !has(CellType::wedge6))
    throw InputError("integration",
                     "'plain' leaves out the internal modes of hexahedra with 8 nodes and of wedges with 6, and the "
                     "mesh has none of these");
}

std::optional<HourglassMode> worst_hourglass_mode(const Solid& solid, const Basis& basis, int threads) {
  const Eigen::Index count = basis.modes() - basis.residual_vectors;
  if (count == 0) return {};
  Solid full = solid;
  full.integration = Integration::standard;
  const RowMatrix modes = basis.shapes.middleCols(basis.kept(), count);
  const RowMatrix forces = assemble_stiffness(full, node_graph(full.mesh, threads), threads).multiply(modes, threads);
  const Eigen::ArrayXd energies = (modes.array() * forces.array()).colwise().sum();
  HourglassMode worst;
  worst.ratio = (energies / basis.eigenvalues.head(count).array()).maxCoeff(&worst.mode);
  return worst;
}

}  // namespace bielle::reduce
