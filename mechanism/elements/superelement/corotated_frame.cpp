#include "mechanism/elements/superelement/corotated_frame.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Weight of an interface that only partly determines the closest placement; its free directions may be far from it.
constexpr double partial_weight = 1e-3;

/// Returns the rotation R that maximises tr(R^T M).
Matrix3 nearest_turn(const Matrix3& M) {
  // Newton's method for the orthogonal factor (N. J. Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160). It takes many
  // iterations for nearly singular matrices and gives a reflection for negative determinants.
  const double determinant = M.determinant(), size = M.norm();
  constexpr double regular = 1e-3, last_step = 1e-8;
  constexpr int most_iterations = 20;
  if (determinant > regular * size * size * size) {
    Matrix3 R = M / std::cbrt(determinant);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const Matrix3 next = 0.5 * (R + Matrix3(R.inverse().transpose()));
      const double step = (next - R).norm();
      R = next;
      if (step < last_step) return R;  // the error of R is now about the square of the step
    }
  }
  const Eigen::JacobiSVD<Matrix3> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 sign(1, 1, 1);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign.z() = -1;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

CorotatedFrame::CorotatedFrame(std::vector<BodyPoint> points, const MatrixX6& A, double size)
    : points_(std::move(points)), At_(A.transpose()), size_(size) {
  Vector3 centre = Vector3::Zero();
  for (const BodyPoint& point : points_) centre += point.X / static_cast<double>(points_.size());
  double largest = 0;
  for (const BodyPoint& point : points_) largest = std::max(largest, (point.X - centre).norm());
  if (largest > coincident_interfaces * size) size_ = largest;
  rows_ = At_.cols();
  while (rows_ > 0 && At_.col(rows_ - 1).isZero(0)) --rows_;
  Matrix3 translation = Matrix3::Zero(), moment = Matrix3::Zero();
  for (const BodyPoint& point : points_) {
    translation += At_.block<3, 3>(0, point.u);
    moment += At_.block<3, 3>(3, point.u);
  }
  translation_inverse_ = translation.inverse();
  lever_ = moment * translation_inverse_;
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
  Frame frame;
  frame.R = nearest_turn(M);
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
    point.rotation.evaluate(geometry.E[k], geometry.q.segment<3>(point.theta), geometry.D[k]);
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

Eigen::Matrix<double, 6, 3> CorotatedFrame::turning(const CorotatedGeometry& geometry) const {
  Eigen::Matrix<double, 6, 3> columns = Eigen::Matrix<double, 6, 3>::Zero();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    columns.noalias() -= At_.middleCols<3>(points_[k].u) * skew(geometry.y[k]);
    if (points_[k].theta >= 0) columns.noalias() += At_.middleCols<3>(points_[k].theta) * geometry.D[k];
  }
  return columns;
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
    // The translations are eliminated.
    const Eigen::Matrix<double, 6, 3> columns = turning(geometry);
    const Matrix3 moved = translation_inverse_ * columns.topRows<3>();
    const Matrix3 remaining = columns.bottomRows<3>() - lever_ * columns.topRows<3>();
    const Matrix3 turn_inverse = remaining.inverse();
    if (last) {
      const auto top = At_.topLeftCorner(3, rows_), bottom = At_.bottomLeftCorner(3, rows_);
      geometry.Sigma.setZero(6, At_.cols());
      auto sigma = geometry.Sigma.leftCols(rows_);
      const Matrix3 turn_by_top = -turn_inverse * lever_;
      sigma.bottomRows<3>().noalias() = turn_inverse * bottom;
      sigma.bottomRows<3>().noalias() += turn_by_top * top;
      const Matrix3 top_by_top = translation_inverse_ - moved * turn_by_top, top_by_bottom = -moved * turn_inverse;
      sigma.topRows<3>().noalias() = top_by_top * top;
      sigma.topRows<3>().noalias() += top_by_bottom * bottom;
      return;
    }
    const Vector6 gap = At_.leftCols(rows_) * geometry.q.head(rows_);
    Vector6 step;
    step.tail<3>() = turn_inverse * (gap.tail<3>() - lever_ * gap.head<3>());
    step.head<3>() = translation_inverse_ * gap.head<3>() - moved * step.tail<3>();
    if (!step.allFinite()) break;
    // Newton's method converges from any nearby value. Steps are limited to half a radian, because the linearisation is
    // invalid beyond it.
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
