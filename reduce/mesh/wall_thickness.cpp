#include "reduce/mesh/wall_thickness.hpp"

#include <vector>

#include <Eigen/Geometry>

#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

double share_one_element_thick(const Mesh& mesh) {
  const FaceTable faces(mesh);
  const SolidCells cells(mesh);
  const std::vector<int> boundary = faces.boundary();
  std::vector<Eigen::Vector3d> normals;                                // area vector of each boundary face
  std::vector<std::vector<std::size_t>> faces_at(mesh.point_count());  // faces at each corner, as positions in
                                                                       // `boundary`
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const Corners corners = faces.corners(boundary[k]);
    normals.push_back(area_vector(mesh.points, corners));
    for (const int corner : corners) faces_at[corner].push_back(k);
  }
  const auto reaches_opposite = [&](std::size_t k) {
    const Corners corners = faces.corners(boundary[k]);
    for (const int vertex : cells.vertices(faces.cell(boundary[k]))) {
      if (corners.contains(vertex)) continue;
      for (const std::size_t other : faces_at[vertex])
        if (normals[k].dot(normals[other]) < -0.5 * normals[k].norm() * normals[other].norm()) return true;
    }
    return false;
  };
  double all = 0, thin = 0;
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const double area = normals[k].norm();
    all += area;
    if (reaches_opposite(k)) thin += area;
  }
  return all > 0 ? thin / all : 0;
}

}  // namespace bielle::reduce
