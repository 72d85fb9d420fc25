#include "reduce/reduction/recovery.hpp"

#include <numeric>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/fe/stress.hpp"
#include "reduce/fe/surface.hpp"
#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

namespace {

void check_on_boundary(const Mesh& mesh, const LoadRequest& request) {
  const FaceTable faces(mesh);
  for (const GroupPart& part : mesh.groups.at(request.group).parts) {
    const Eigen::MatrixXi& nodes = mesh.block(part.type)->nodes;
    for (const int cell : part.cells) {
      const auto face = faces.find({nodes(0, cell), nodes(1, cell), nodes(2, cell)});
      if (!face || !faces.on_boundary(*face)) {
        throw InputError(
            fmt::format("{}: surface '{}' has faces inside the body, on which a pressure has no direction; "
                        "give a traction or a force",
                        request.located, request.group));
      }
    }
  }
}

Eigen::Matrix3Xd nodal_forces(const Mesh& mesh, const SurfaceIntegrals& surface, const LoadRequest& request) {
  if (request.pressure) {
    check_on_boundary(mesh, request);
    return pressure_forces(surface, *request.pressure);
  }
  if (request.traction) {
    return traction_forces(surface, *request.traction);
  }
  if (request.force) {
    return spread_force(surface, *request.force);
  }
  throw InputError(fmt::format("{}: a load needs a pressure, a traction or a force", request.located));
}

/// The mesh as the superelement keeps it: all of it, or its skin with points numbered anew.
SuperelementMesh kept_mesh(const Solid& solid, const std::vector<int>& points, bool skin) {
  SuperelementMesh result;
  result.points = solid.mesh.points(Eigen::all, points);
  std::vector<int> number(solid.points(), -1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    number[points[k]] = static_cast<int>(k);
  }
  if (skin) {
    const FaceTable faces(solid.mesh);
    const std::vector<int> boundary = faces.boundary();
    Eigen::MatrixXi cells(node_count(faces.type()), boundary.size());
    for (std::size_t f = 0; f < boundary.size(); ++f) {
      cells.col(static_cast<Eigen::Index>(f)) = faces.nodes(boundary[f]).unaryExpr([&](int a) { return number[a]; });
    }
    result.cells[static_cast<int>(faces.type())] = std::move(cells);
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

}  // namespace

std::map<std::string, LoadPattern> reduce_loads(const Solid& solid, const std::vector<LoadRequest>& requests,
                                                const RowMatrix& shapes) {
  std::map<std::string, LoadPattern> result;
  for (const LoadRequest& request : requests) {
    SurfaceIntegrals surface;
    try {
      surface = integrate_surface(solid.mesh, request.group);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", request.located, error.what()));
    }
    const Eigen::Matrix3Xd forces = nodal_forces(solid.mesh, surface, request);
    LoadPattern pattern;
    for (auto& force : pattern.force) {
      force = Eigen::Matrix3Xd::Zero(3, shapes.cols());
    }
    for (std::size_t a = 0; a < surface.nodes.size(); ++a) {
      for (int k = 0; k < 3; ++k) {
        pattern.force[k] += forces(k, static_cast<Eigen::Index>(a)) * shapes.middleRows<3>(3 * surface.nodes[a]);
      }
    }
    if (!result.emplace(request.name, std::move(pattern)).second) {
      throw InputError(fmt::format("{}: there are two loads '{}'", request.located, request.name));
    }
  }
  return result;
}

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
    for (std::size_t k = 0; k < points.size(); ++k) {
      result.displacement_recovery.middleRows<3>(3 * static_cast<Eigen::Index>(k)) =
          shapes.middleRows<3>(3 * static_cast<Eigen::Index>(points[k]));
    }
  }
  if (options.stress_recovery == RecoveryExtent::none) {
    return;
  }
  std::vector<int> nodes = surface_nodes(solid);
  if (options.stress_recovery == RecoveryExtent::all) {
    const std::vector<bool> inside = points_of_solid(solid);
    nodes.clear();
    for (int a = 0; a < solid.points(); ++a) {
      if (inside[a]) {
        nodes.push_back(a);
      }
    }
  }
  result.stress_recovery = nodal_stress(solid, shapes, nodes, threads);
  result.stress_nodes = nodes;
  if (skin) {
    std::iota(result.stress_nodes.begin(), result.stress_nodes.end(), 0);
  }
}

}  // namespace bielle::reduce
