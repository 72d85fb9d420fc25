#include "reduce/mesh/wall_thickness.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

double share_one_element_thick(const Mesh& mesh) {
  const FaceTable faces(mesh);
  const Eigen::MatrixXi& cells = mesh.solids().nodes;
  const int vertices = vertex_count(mesh.solids().type);
  const std::vector<int> boundary = faces.boundary();
  std::vector<Eigen::Vector3d> normals;  // normal of each boundary face, with twice its area as its length
  std::vector<std::vector<std::size_t>> faces_at(mesh.point_count());  // faces at each corner, as positions in
                                                                       // `boundary`
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const FaceCorners corners = faces.corners(boundary[k]);
    normals.push_back(twice_area(mesh.points, corners));
    for (const int corner : corners) faces_at[corner].push_back(k);
  }
  double all = 0, thin = 0;
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const FaceCorners corners = faces.corners(boundary[k]);
    const auto cell = cells.col(faces.cell(boundary[k]));
    const double area = normals[k].norm();
    bool is_thin = false;
    for (int v = 0; v < vertices; ++v) {
      if (std::find(corners.begin(), corners.end(), cell(v)) != corners.end()) continue;
      for (const std::size_t other : faces_at[cell(v)])
        is_thin = is_thin || normals[k].dot(normals[other]) < -0.5 * area * normals[other].norm();
    }
    all += area;
    if (is_thin) thin += area;
  }
  return all > 0 ? thin / all : 0;
}

}  // namespace bielle::reduce
