#include "mechanism/elements/superelement/frame_conditions.hpp"

#include <cmath>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"

namespace bielle::mechanism {
namespace {

/// Returns l^2 of the mean frame [m^2].
double rotation_weight(const SuperelementMatrices& body) {
  if (body.points.size() == 1) return 1;
  const auto count = static_cast<double>(body.points.size());
  Vector3 mean = Vector3::Zero();
  for (const BodyPoint& point : body.points) mean += point.X / count;
  double weight = 0;
  for (const BodyPoint& point : body.points) weight += (point.X - mean).squaredNorm() / count;
  const double gyration = body.gyration * body.gyration;
  return weight > coincident_interfaces * coincident_interfaces * gyration ? weight : gyration;
}

}  // namespace

MatrixX6 mean_conditions(const SuperelementMatrices& body) {
  const Eigen::Index rows = body.interface_rows();
  VectorX weights = VectorX::Ones(rows);
  for (const BodyPoint& point : body.points)
    if (point.theta >= 0) weights.segment<3>(point.theta).setConstant(rotation_weight(body));
  MatrixX6 A = MatrixX6::Zero(body.size(), 6);
  const MatrixX weighted = weights.asDiagonal() * body.kept;
  add_product(A.topRows(rows), weighted, body.U.topRows(rows));
  return A;
}

MatrixX6 mean_axes_conditions(const SuperelementMatrices& body) { return body.MU; }

MatrixX6 carried_conditions(const SuperelementMatrices& body, std::size_t interface) {
  const BodyPoint& point = body.points[interface];
  if (!point.keeps_position || point.rotation.kind() != InterfaceRotation::Kind::vector)
    throw InputError("an interface that carries the frame must keep all its translations and rotations");
  MatrixX6 A = MatrixX6::Zero(body.size(), 6);
  A.middleRows<3>(point.u) = body.U.middleRows<3>(point.u);
  A.middleRows<3>(point.theta) = body.U.middleRows<3>(point.theta);
  return A;
}

}  // namespace bielle::mechanism
