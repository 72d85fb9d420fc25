#include "mechanism/elements/superelement/linear_coordinates.hpp"

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// A step of this size relative to eps is the last one: the error after it is about its square.
constexpr double last_step = 1e-9;
constexpr int most_iterations = 25;

}  // namespace

void LinearCoordinates::solve(const SuperelementMatrices& body, const VectorX& q) {
  eps_ = q;
  const Eigen::Index b = body.prestress_rows(), n = q.size();
  J_.resize(b, b);
  if (b == 0) return;
  const auto scale = body.interface_scale.array();  // makes translations and rotations comparable
  gradient_.resize(n, b);
  step_.resize(b);
  residual_.resize(b);
  body.multiply_load_stiffness(eps_, gradient_);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    residual_.noalias() = gradient_.transpose() * eps_;
    residual_ = eps_.head(b) - 0.5 * residual_ - q.head(b);
    J_ = MatrixX::Identity(b, b) - gradient_.topRows(b).transpose();
    factors_.compute(J_);
    // Beyond a zero of the determinant one q belongs to two eps, and this one would be wrong.
    if (!(factors_.determinant() > 0)) break;
    factors_.solve(residual_, step_);
    eps_.head(b) -= step_;
    body.subtract_load_stiffness(step_, gradient_);
    if (!eps_.allFinite()) break;
    const double size = (eps_.head(b).array() * scale).matrix().norm();
    if ((step_.array() * scale).matrix().norm() > last_step * size) continue;
    J_ = MatrixX::Identity(b, b) - gradient_.topRows(b).transpose();
    factors_.compute(J_);
    factors_.set_inverse(J_);
    return;
  }
  throw ComputationError(
      "it is deformed beyond what the theory of second order describes (bodies that bend or twist by more "
      "than some 0.3 rad want several superelements: `pieces` in the body file)");
}

void LinearCoordinates::set_excess() {
  excess_.resize(rows(), eps_.size());
  if (rows() > 0) excess_.noalias() = J_ * gradient_.transpose();
}

void LinearCoordinates::multiply_gradient(const MatrixX& gradient, MatrixX& product) const {
  product.noalias() = J_ * gradient.transpose();
}

void LinearCoordinates::multiply(VectorX& v) {
  const Eigen::Index b = rows(), m = v.size() - b;
  if (b == 0) return;
  step_ = v.head(b);
  step_.noalias() += gradient_.bottomRows(m).transpose() * v.tail(m);
  v.head(b).noalias() = J_ * step_;
}

void LinearCoordinates::multiply_transposed(VectorX& v) {
  const Eigen::Index b = rows(), m = v.size() - b;
  if (b == 0) return;
  step_.noalias() = J_.transpose() * v.head(b);
  v.head(b) = step_;
  v.tail(m).noalias() += gradient_.bottomRows(m) * step_;
}

}  // namespace bielle::mechanism
