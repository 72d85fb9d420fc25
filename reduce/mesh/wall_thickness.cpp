#include "reduce/mesh/wall_thickness.hpp"

#include <vector>

#include <Eigen/Geometry>

#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

double share_one_element_thick(const Mesh& mesh) {
  const FaceTable faces(mesh);
  const Eigen::MatrixXi& cells = mesh.solids().nodes;
  const std::vector<int> boundary = faces.boundary();
  std::vector<Eigen::Vector3d> normals;  // normal of each boundary face, with twice its area as its length
  std::vector<std::vector<std::size_t>> faces_at(mesh.point_count());  // faces at each corner, as positions in
                                                                       // `boundary`
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const std::array<int, 3> corners = faces.corners(boundary[k]);
    const Eigen::Vector3d a = mesh.points.col(corners[0]), b = mesh.points.col(corners[1]),
                          c = mesh.points.col(corners[2]);
    normals.push_back((b - a).cross(c - a));
    for (const int corner : corners) faces_at[corner].push_back(k);
  }
  double all = 0, thin = 0;
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const std::array<int, 3> corners = faces.corners(boundary[k]);
    const auto cell = cells.col(faces.cell(boundary[k]));
    const double area = normals[k].norm();
    int opposite = -1;
    for (int v = 0; v < 4; ++v)
      if (cell(v) != corners[0] && cell(v) != corners[1] && cell(v) != corners[2]) opposite = cell(v);
    all += area;
    for (const std::size_t other : faces_at[opposite])
      if (normals[k].dot(normals[other]) < -0.5 * area * normals[other].norm()) {
        thin += area;
        break;
      }
  }
  return all > 0 ? thin / all : 0;
}

}  // namespace bielle::reduce
