#include "mechanism/elements/superelement/corotated_frame.hpp"

#include <algorithm>

#include <Eigen/SVD>
#include <fmt/format.h>

#include "mechanism/math/inverse.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"

namespace bielle::mechanism {
namespace {

/// Weight in the closest placement of an interface that determines it only in part (its free directions may be far
/// away).
constexpr double partial_weight = 1e-3;

}  // namespace

CorotatedFrame::CorotatedFrame(std::vector<BodyPoint> points, const MatrixX6& A, double size)
    : points_(std::move(points)), At_(A.transpose()), size_(size) {
  Vector3 centre = Vector3::Zero();
  for (const BodyPoint& point : points_) centre += point.X / static_cast<double>(points_.size());
  double largest = 0;
  for (const BodyPoint& point : points_) largest = std::max(largest, (point.X - centre).norm());
  if (largest > coincident_interfaces * size) size_ = largest;
}

Frame CorotatedFrame::closest_placement(const LocalState& state) const {
  double weight = 0;
  Vector3 x_mean = Vector3::Zero(), X_mean = Vector3::Zero();
  const auto weight_of = [](const BodyPoint& point) { return point.keeps_position ? 1.0 : partial_weight; };
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const double w = weight_of(points_[k]);
    weight += w;
    x_mean += w * state.node(static_cast<int>(k)).x;
    X_mean += w * points_[k].X;
  }
  x_mean /= weight;
  X_mean /= weight;

  // R_0 maximises tr(R_0^T M), where M is the sum of (x - x_mean)(X - X_mean)^T and of the rotations of the interfaces.
  Matrix3 M = Matrix3::Zero();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const BodyPoint& point = points_[k];
    const NodeState& node = state.node(static_cast<int>(k));
    M += weight_of(point) * (node.x - x_mean) * (point.X - X_mean).transpose();
    const Matrix3 R = node.R * point.R_ref.transpose();
    const Vector3& e = point.rotation.axis();
    switch (point.rotation.kind()) {
      case InterfaceRotation::Kind::vector:
        M += size_ * size_ * R;
        break;
      case InterfaceRotation::Kind::tilt:
        M += size_ * size_ * (R * e) * e.transpose();
        break;
      case InterfaceRotation::Kind::twist:
        M += partial_weight * size_ * size_ * R;
        break;
      case InterfaceRotation::Kind::none:
        break;
    }
  }
  const Eigen::JacobiSVD<Matrix3> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 sign(1, 1, 1);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign.z() = -1;
  Frame frame;
  frame.R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  frame.x = x_mean - frame.R * X_mean;
  return frame;
}

void CorotatedFrame::update(const LocalState& state, CorotatedGeometry& geometry) const {
  const Frame& frame = geometry.frame;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const BodyPoint& point = points_[k];
    const NodeState& node = state.node(static_cast<int>(k));
    geometry.y[k] = frame.R.transpose() * (node.x - frame.x);
    geometry.q.segment<3>(point.u) = geometry.y[k] - point.X;
    geometry.V.block<3, 3>(point.u, 3) = -skew(geometry.y[k]);
    if (point.theta < 0) continue;
    geometry.E[k] = frame.R.transpose() * node.R * point.R_ref.transpose();
    geometry.D[k] = point.rotation.differential(geometry.E[k]);
    geometry.q.segment<3>(point.theta) = point.rotation.coordinate(geometry.E[k]);
    geometry.V.block<3, 3>(point.theta, 3) = geometry.D[k];
  }
}

std::string CorotatedFrame::misfit(const LocalState& state, CorotatedGeometry& geometry) const {
  geometry.frame = closest_placement(state);
  update(state, geometry);
  if (!geometry.q.allFinite()) return "the positions of its interfaces are no numbers any more";
  double distance = 0, angle = 0;
  for (const BodyPoint& point : points_) {
    distance = std::max(distance, geometry.q.segment<3>(point.u).norm());
    if (point.theta >= 0) angle = std::max(angle, geometry.q.segment<3>(point.theta).norm());
  }
  return fmt::format(
      "no small deformation takes the body, {:.3g} m in size, to where its interfaces are: {:.3g} m and "
      "{:.3g} rad off the nearest rigid placement",
      size_, distance, angle);
}

void CorotatedFrame::solve(const LocalState& state, CorotatedGeometry& geometry) const {
  const auto count = points_.size();
  geometry.q.resize(At_.cols());
  geometry.q.tail(state.slots().amplitudes) = state.amplitude();
  geometry.y.resize(count);
  geometry.E.assign(count, Matrix3::Identity());
  geometry.D.assign(count, Matrix3::Zero());
  geometry.V.setZero(At_.cols(), 6);
  for (const BodyPoint& point : points_) geometry.V.block<3, 3>(point.u, 0).setIdentity();

  geometry.frame = closest_placement(state);
  bool last = false;
  for (int iteration = 0; iteration < 50; ++iteration) {
    update(state, geometry);
    Matrix6 S = Matrix6::Zero();
    add_product(S, At_, geometry.V);
    const Matrix6 S_inverse = inverse(S);
    if (last) {
      geometry.Sigma.setZero(6, At_.cols());
      add_product(geometry.Sigma, S_inverse, At_);
      return;
    }
    Vector6 gap = Vector6::Zero();
    add_product(gap, At_, geometry.q);
    Vector6 step = S_inverse * gap;
    if (!step.allFinite()) break;
    // Newton's method converges from any nearby value; the problem is no longer linear for steps beyond half a radian.
    const double angle = step.tail<3>().norm();
    if (angle > 0.5) step *= 0.5 / angle;
    geometry.frame.x += geometry.frame.R * step.head<3>();
    geometry.frame.R = geometry.frame.R * exp_so3(step.tail<3>());
    // The error after a step is about its square.
    last = angle < 1e-8 && step.head<3>().norm() < 1e-8 * size_;
  }
  throw ComputationError(misfit(state, geometry));
}

}  // namespace bielle::mechanism
