#include "reduce/fe/surface.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/sort_unique.hpp"
#include "reduce/fe/face_points.hpp"

namespace bielle::reduce {

namespace {

std::vector<std::string> surface_groups(const Mesh& mesh) {
  std::vector<std::string> result;
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension == 2) {
      result.push_back(name);
    }
  }
  return result;
}

/// Calls visit(nodes of the face, N_a, x, int n dA of the point) at every point of all faces.
template <typename Visitor>
void integrate(const Mesh& mesh, const Group& group, const Visitor& visit) {
  for_each_face(mesh, group, [&](const FacePoints& face) {
    for (Eigen::Index p = 0; p < face.places.cols(); ++p)
      visit(face.nodes, face.values[static_cast<std::size_t>(p)], Eigen::Vector3d(face.places.col(p)),
            Eigen::Vector3d(face.normals.col(p)));
  });
}

}  // namespace

const Group& surface_group(const Mesh& mesh, const std::string& name) {
  const auto place = mesh.groups.find(name);
  if (place == mesh.groups.end() || place->second.dimension != 2) {
    throw InputError(
        fmt::format("the mesh has no surface group '{}'{}", name, did_you_mean(name, surface_groups(mesh))));
  }
  return place->second;
}

SurfaceIntegrals integrate_surface(const Mesh& mesh, const std::string& name) {
  const Group& group = surface_group(mesh, name);
  SurfaceIntegrals result;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  integrate(mesh, group, [&](const auto& nodes, const auto&, const Eigen::Vector3d& x, const Eigen::Vector3d& normal) {
    result.nodes.insert(result.nodes.end(), nodes.begin(), nodes.end());
    result.area += normal.norm();
    first += normal.norm() * x;
  });
  if (!(result.area > 0)) {
    throw InputError(fmt::format("the surface group '{}' has no area", name));
  }
  sort_unique(result.nodes);
  result.centroid = first / result.area;

  const auto count = static_cast<Eigen::Index>(result.nodes.size());
  result.weights = Eigen::VectorXd::Zero(count);
  result.first_moments = result.normals = Eigen::Matrix3Xd::Zero(3, count);
  integrate(mesh, group,
            [&](const auto& nodes, const auto& n, const Eigen::Vector3d& x, const Eigen::Vector3d& normal) {
              const Eigen::Vector3d r = x - result.centroid;
              const double area = normal.norm();
              result.second_moment += area * r * r.transpose();
              for (Eigen::Index a = 0; a < nodes.size(); ++a) {
                const auto column =
                    std::lower_bound(result.nodes.begin(), result.nodes.end(), nodes(a)) - result.nodes.begin();
                result.weights(column) += area * n(a);
                result.first_moments.col(column) += area * n(a) * r;
                result.normals.col(column) += n(a) * normal;
              }
            });
  return result;
}

Eigen::Matrix3Xd pressure_forces(const SurfaceIntegrals& surface, double pressure) {
  return -pressure * surface.normals;
}

Eigen::Matrix3Xd traction_forces(const SurfaceIntegrals& surface, const Eigen::Vector3d& traction) {
  return traction * surface.weights.transpose();
}

Eigen::Matrix3Xd spread_force(const SurfaceIntegrals& surface, const Eigen::Vector3d& force) {
  return traction_forces(surface, force / surface.area);
}

}  // namespace bielle::reduce
