#include "mechanism/elements/superelement/attached_point.hpp"

#include "mechanism/math/so3.hpp"
#include "reduce/dense/dense_products.hpp"

namespace bielle::mechanism {
namespace {

const InterfaceRotation rotation(Matrix3::Identity(), {true, true, true});

}  // namespace

AttachedPoint::AttachedPoint(const PointPlace& place, const SuperelementMotion& motion, const NodeState& node,
                             const Vector6& multiplier, const Vector3& gravity)
    : place_(place), motion_(motion), multiplier_(multiplier) {
  const Frame& frame = motion.geometry.frame;
  const Matrix3 R_0t = frame.R.transpose();
  y_ = R_0t * (node.x - frame.x);
  E_ = R_0t * node.R * place.R_ref.transpose();
  D_ = rotation.differential(E_);
  m_.head<3>() = multiplier.head<3>();
  m_.tail<3>() = D_.transpose() * multiplier.tail<3>();

  // The body's own accelerations are those relative to free fall.
  const Vector3 v_0 = motion.nu.head<3>(), Om = motion.nu.tail<3>();
  const Vector3 a_0 = motion.nu_rate.head<3>(), Om_rate = motion.nu_rate.tail<3>();
  const Vector3 w_u = R_0t * node.v, w_theta = R_0t * node.R * node.Omega;
  w_rel_.head<3>() = w_u - v_0 - Om.cross(y_);
  w_rel_.tail<3>() = w_theta - Om;
  a_rel_.head<3>() = R_0t * (node.a - gravity) - Om.cross(w_u + w_rel_.head<3>()) - a_0 - Om_rate.cross(y_);
  a_rel_.tail<3>() = R_0t * node.R * node.Omegadot - Om.cross(w_theta) - Om_rate;
}

Vector6 AttachedPoint::gap() const {
  Vector6 q;
  q << y_ - place_.X, rotation.coordinate(E_);
  return q - place_.T * motion_.coordinates.eps();
}

Vector6 AttachedPoint::gap_rate() const {
  Vector6 rate = w_rel_;
  rate.tail<3>() = D_ * w_rel_.tail<3>();
  return rate - place_.T * motion_.eps_rate;
}

Vector6 AttachedPoint::gap_acceleration() const {
  const Vector3 turning = w_rel_.tail<3>();
  Vector6 acceleration = a_rel_;
  acceleration.tail<3>() = D_ * a_rel_.tail<3>() + rotation.differential_rate(E_, turning) * turning;
  return acceleration - place_.T * motion_.eps_acceleration;
}

Vector6 AttachedPoint::wrench() const {
  Vector6 result = m_;
  result.tail<3>() += y_.cross(Vector3(m_.head<3>()));
  return result;
}

void AttachedPoint::add_tangent(int multiplier_row, const Matrix6X& frame, const Matrix6X& node, const Matrix6X& shape,
                                Eigen::Ref<MatrixX> target) const {
  const Matrix3 force = skew(m_.head<3>()), moment = skew(m_.tail<3>());
  const Matrix3 Z = rotation.transpose_gradient(E_, multiplier_.tail<3>());
  Matrix6 carried = Matrix6::Identity();  // U_c
  carried.topRightCorner<3, 3>() = -skew(y_);
  const Matrix6X delta = node - carried * frame;

  // Q^T m rotates with the frame, and the moment also with the node.
  Matrix6X change(6, target.cols());
  change.topRows<3>() = -force * frame.bottomRows<3>();
  change.bottomRows<3>() = (moment + Z) * delta.bottomRows<3>();
  add_transposed_product(target, node, change);
  // -U_c^T m on the frame: -[0; delta_u x m_u + Z delta_theta]
  change.topRows<3>().setZero();
  change.bottomRows<3>() = force * delta.topRows<3>() - Z * delta.bottomRows<3>();
  add_transposed_product(target, frame, change);

  change = delta - shape;
  change.bottomRows<3>() = D_ * delta.bottomRows<3>() - shape.bottomRows<3>();
  target.middleRows<6>(multiplier_row) += change;
  target.middleCols<6>(multiplier_row) += change.transpose();
}

}  // namespace bielle::mechanism
