#include "reduce/reduction/recovery.hpp"

#include <map>
#include <numeric>
#include <set>

#include "reduce/common/error.hpp"
#include "reduce/fe/stress.hpp"
#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

namespace {

/// Returns the mesh that the superelement keeps: all of it, or its skin with points numbered anew.
SuperelementMesh kept_mesh(const Solid& solid, const std::vector<int>& points, bool skin) {
  SuperelementMesh result;
  result.points = solid.mesh.points(Eigen::all, points);
  std::vector<int> number(solid.points(), -1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    number[points[k]] = static_cast<int>(k);
  }
  if (skin) {
    const FaceTable faces(solid.mesh);
    std::map<CellType, std::vector<int>> of_type;
    for (const int face : faces.boundary()) {
      of_type[faces.type(face)].push_back(face);
    }
    for (const auto& [type, boundary] : of_type) {
      Eigen::MatrixXi cells(node_count(type), boundary.size());
      for (std::size_t f = 0; f < boundary.size(); ++f) {
        cells.col(static_cast<Eigen::Index>(f)) = faces.nodes(boundary[f]).unaryExpr([&](int a) { return number[a]; });
      }
      result.cells[static_cast<int>(type)] = std::move(cells);
    }
  } else {
    for (const CellBlock& block : solid.mesh.blocks) {
      result.cells[static_cast<int>(block.type)] = block.nodes;
    }
  }
  for (const auto& [name, group] : solid.mesh.groups) {
    std::vector<int>& nodes = result.groups[name];
    for (const int a : group.nodes) {
      if (number[a] >= 0) {
        nodes.push_back(number[a]);
      }
    }
  }
  return result;
}

/// Gives each node of a wound material an elasticity of its own, in the axes of the body.
void unwind(const Solid& solid, const std::vector<int>& nodes, StressOrigin& origin) {
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    const Material& material = solid.materials[static_cast<std::size_t>(origin.material_of[row])];
    if (!material.is_wound()) continue;
    const Eigen::Vector3d place = solid.mesh.points.col(nodes[row]);
    if (!material.axes_at(place).allFinite()) continue;  // on the line itself
    origin.materials.push_back(
        {origin.materials[static_cast<std::size_t>(origin.material_of[row])].name, material.elasticity_at(place)});
    origin.material_of[row] = static_cast<int>(origin.materials.size()) - 1;
  }
}

/// Materials and volume groups of the stress at nodes. A node on the boundary of two materials belongs to the groups of
/// the material whose stress it has.
StressOrigin stress_origin(const Solid& solid, const std::map<std::string, Material>& materials,
                           const std::vector<int>& nodes) {
  StressOrigin result;
  for (const auto& [name, material] : materials) {  // in the order of Solid::materials
    result.materials.push_back({name, material.elasticity});
  }
  result.material_of = nodal_materials(solid, nodes);
  std::vector<int> row_of(solid.points(), -1);
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    row_of[nodes[row]] = static_cast<int>(row);
  }
  for (const auto& [name, group] : solid.mesh.groups) {
    std::set<int> rows;
    for (const int cell : solid.cells.members(group)) {
      for (const int node : solid.cells.nodes(cell)) {
        if (const int row = row_of[node]; row >= 0 && result.material_of[row] == solid.material_of[cell]) {
          rows.insert(row);
        }
      }
    }
    if (!rows.empty()) {
      result.groups[name] = {rows.begin(), rows.end()};
    }
  }
  unwind(solid, nodes, result);
  return result;
}

}  // namespace

void add_recovery(const Solid& solid, const ReductionOptions& options, const RowMatrix& shapes, int threads,
                  Superelement& result) {
  const bool skin = options.displacement_recovery == RecoveryExtent::surface;
  if (skin && options.stress_recovery == RecoveryExtent::all) {
    throw InputError("recovery: stress: all needs displacement: all, since the superelement then keeps the whole mesh");
  }
  std::vector<int> points(solid.points());
  std::iota(points.begin(), points.end(), 0);
  if (skin) {
    points = surface_nodes(solid);
  }
  result.mesh = kept_mesh(solid, points, skin);
  if (options.displacement_recovery != RecoveryExtent::none) {
    result.displacement_recovery.resize(3 * static_cast<Eigen::Index>(points.size()), shapes.cols());
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t k = 0; k < points.size(); ++k) {
      result.displacement_recovery.middleRows<3>(3 * static_cast<Eigen::Index>(k)) =
          shapes.middleRows<3>(3 * static_cast<Eigen::Index>(points[k]));
    }
  }
  if (options.stress_recovery == RecoveryExtent::none) {
    return;
  }
  const std::vector<int> nodes =
      options.stress_recovery == RecoveryExtent::all ? nodes_of_solid(solid) : surface_nodes(solid);
  result.stress_recovery = nodal_stress(solid, shapes, nodes, threads);
  result.stress_origin = stress_origin(solid, options.materials, nodes);
  result.stress_nodes = nodes;
  if (skin) {
    std::iota(result.stress_nodes.begin(), result.stress_nodes.end(), 0);
  }
}

}  // namespace bielle::reduce
