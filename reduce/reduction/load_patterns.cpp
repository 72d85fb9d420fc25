#include "reduce/reduction/load_patterns.hpp"

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/fe/surface.hpp"
#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

namespace {

void check_on_boundary(const Mesh& mesh, const LoadRequest& request) {
  const FaceTable faces(mesh);
  for (const GroupPart& part : mesh.groups.at(request.group).parts) {
    const Eigen::MatrixXi& nodes = mesh.block(part.type)->nodes;
    for (const int cell : part.cells) {
      const auto face = faces.find(corners_of(part.type, nodes.col(cell)));
      if (!face || !faces.on_boundary(*face)) {
        throw InputError(request.subject,
                         fmt::format("surface '{}' has faces inside the body, on which a pressure has no direction; "
                                     "give a traction or a force",
                                     request.group));
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
  throw InputError(request.subject, "a load needs a pressure, a traction or a force");
}

}  // namespace

PatternForces pattern_forces(const Mesh& mesh, const LoadRequest& request) {
  const SurfaceIntegrals surface = about(request.subject, [&] { return integrate_surface(mesh, request.group); });
  return {surface.nodes, nodal_forces(mesh, surface, request)};
}

std::map<std::string, LoadPattern> reduce_loads(const Solid& solid, const std::vector<LoadRequest>& requests,
                                                const RowMatrix& shapes) {
  std::map<std::string, LoadPattern> result;
  for (const LoadRequest& request : requests) {
    const PatternForces on_nodes = pattern_forces(solid.mesh, request);
    LoadPattern pattern;
    for (auto& force : pattern.force) {
      force = Eigen::Matrix3Xd::Zero(3, shapes.cols());
    }
    for (std::size_t a = 0; a < on_nodes.nodes.size(); ++a) {
      for (int k = 0; k < 3; ++k) {
        pattern.force[k] +=
            on_nodes.forces(k, static_cast<Eigen::Index>(a)) * shapes.middleRows<3>(3 * on_nodes.nodes[a]);
      }
    }
    if (!result.emplace(request.name, std::move(pattern)).second) {
      throw InputError(request.subject, fmt::format("there are two loads '{}'", request.name));
    }
  }
  return result;
}

}  // namespace bielle::reduce
