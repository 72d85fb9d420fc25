#include "mechanism/elements/superelement/point_shapes.hpp"

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/superelement/point_weights.hpp"

namespace bielle::mechanism {

MatrixX point_shapes(const Superelement& body, const Vector3& point) {
  if (body.displacement_recovery.rows() == 0)
    throw InputError(
        fmt::format("the superelement '{}' keeps no displacements of its mesh; reduce it with `recovery: "
                    "{{displacement: all}}`",
                    body.name));
  const PointWeights weights = point_weights(body.mesh.points, point, body.name);
  MatrixX shapes = MatrixX::Zero(6, body.displacement_recovery.cols());
  for (std::size_t k = 0; k < weights.nodes.size(); ++k)
    shapes += weights.rows.middleCols<3>(3 * static_cast<Eigen::Index>(k)) *
              body.displacement_recovery.middleRows<3>(3 * weights.nodes[k]);
  return shapes;
}

}  // namespace bielle::mechanism
