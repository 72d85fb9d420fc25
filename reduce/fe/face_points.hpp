// The faces of a surface group at the points of a quadrature rule. Internal to reduce/fe.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/quadrature.hpp"
#include "reduce/mesh/shape_functions.hpp"

namespace bielle::reduce {

/// A face at the points of a rule of degree 7, which is exact for N_a n on curved faces of order 2 and for N_a x |n|
/// and N_a N_b |n| on plane ones, and nearly exact if |n| is no polynomial.
struct FacePoints {
  CellType type;
  Eigen::VectorXi nodes;
  const std::vector<Eigen::VectorXd>& values;  ///< N_a at each point
  Eigen::Matrix3Xd places;                     ///< x of each point [m]
  Eigen::Matrix3Xd normals;                    ///< n dA of each point, as the face is oriented in the mesh [m^2]
};

/// Calls work(FacePoints) for every face of a surface group.
template <typename Work>
void for_each_face(const Mesh& mesh, const Group& group, const Work& work) {
  for (const GroupPart& part : group.parts) {
    const Quadrature rule = cell_quadrature(part.type, 7);
    std::vector<Eigen::VectorXd> values;
    std::vector<Eigen::MatrixXd> gradients;
    for (const auto& xi : rule.points.colwise()) {
      values.push_back(shape_values(part.type, xi));
      gradients.push_back(shape_gradients(part.type, xi));
    }
    const auto count = static_cast<Eigen::Index>(values.size());
    FacePoints face{part.type, {}, values, Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
    const Eigen::MatrixXi& cells = mesh.block(part.type)->nodes;
    for (const int cell : part.cells) {
      face.nodes = cells.col(cell);
      const Eigen::Matrix3Xd points = mesh.points(Eigen::all, face.nodes);
      for (Eigen::Index p = 0; p < count; ++p) {
        const auto k = static_cast<std::size_t>(p);
        const Eigen::Matrix<double, 3, 2> tangents = points * gradients[k];
        face.places.col(p) = points * values[k];
        face.normals.col(p) = rule.weights(p) * tangents.col(0).cross(tangents.col(1));
      }
      work(face);
    }
  }
}

}  // namespace bielle::reduce
