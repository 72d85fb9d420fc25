#include "mechanism/elements/superelement/linear_coordinates.hpp"

#include <cmath>

#include "reduce/common/error.hpp"
#include "reduce/dense/dense_products.hpp"

namespace bielle::mechanism {
namespace {

/// A step of Newton's method of this size relative to eps is the last one: the error after it is about its square.
constexpr double last_step = 1e-9;
/// While steps are smaller than this, the first terms of the series (I - G)^-1 = I + G + G^2 + .. take the place of
/// factors, unless the last step was not much smaller than the one before.
constexpr double small_step = 0.03, slow = 0.1;
/// Error and step, relative to eps, at the end of steps by the series. The error is estimated by the rate of two steps.
constexpr double last_error = 1e-17, last_step_of_series = 1e-15;
constexpr int most_iterations = 25;

}  // namespace

void LinearCoordinates::set_shortening(const SuperelementMatrices& body) {
  const auto interfaces = eps_.head(rows());
  gradient_.interfaces = interfaces_by_modes_;
  body.add_load_stiffness_interfaces(interfaces, gradient_.interfaces);
  J_ = gradient_.interfaces + interfaces_by_modes_;
  shortening_ = by_modes_;
  shortening_.noalias() += 0.5 * J_.transpose() * interfaces;
}

bool LinearCoordinates::factorise() {
  J_ = -gradient_.interfaces.transpose();
  J_.diagonal().array() += 1;
  factors_.compute(J_);
  return factors_.determinant() > 0;
}

void LinearCoordinates::solve(const SuperelementMatrices& body, const VectorX& q) {
  eps_ = q;
  const Eigen::Index b = body.prestress_rows(), modes = q.size() - b;
  if (b == 0) return;
  const auto norm = [&](const auto& rows) { return (rows.array() * body.interface_scale.array()).matrix().norm(); };
  for (VectorX* vector : {&step_, &product_, &sum_}) vector->resize(b);
  J_.resize(b, b);
  body.multiply_load_stiffness_by_modes(q.tail(modes), gradient_);
  interfaces_by_modes_ = gradient_.interfaces;
  by_modes_.noalias() = 0.5 * gradient_.modes.transpose() * q.tail(modes);
  set_shortening(body);
  const double size_of_q = norm(q.head(b));
  double before = norm(shortening_);
  bool by_series = before < small_step * size_of_q, rate_is_known = false;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    step_ = q.head(b) + shortening_ - eps_.head(b);
    if (by_series) {
      sum_ = step_;
      for (int terms = 0; terms < 2; ++terms) {
        product_.noalias() = gradient_.interfaces.transpose() * sum_;
        sum_ = step_ + product_;
      }
      step_ = sum_;
    } else {
      // Beyond a zero of the determinant two eps belong to one q, and this iteration would lead to the wrong one.
      if (!factorise()) break;
      factors_.solve(step_);
    }
    eps_.head(b) += step_;
    set_shortening(body);
    const double step = norm(step_), size = size_of_q + norm(eps_.head(b));
    if (!std::isfinite(size)) break;
    const bool is_last = !by_series                              ? step <= last_step * size
                         : rate_is_known && step < slow * before ? step * step <= last_error * size * before
                                                                 : step <= last_step_of_series * size;
    if (is_last) {
      if (!factorise()) break;  // the determinant is checked as above
      body.add_load_stiffness_modes(eps_.head(b), gradient_.modes);
      return;
    }
    const bool series_next = step < small_step * size && (iteration == 0 || step < slow * before);
    rate_is_known = by_series && series_next;
    by_series = series_next;
    before = step;
  }
  throw ComputationError(
      "it is deformed beyond what the theory of second order describes (bodies that bend or twist by more than some "
      "0.3 rad need several superelements: `pieces` in the body file)");
}

void LinearCoordinates::set_excess() {
  const Eigen::Index b = rows();
  excess_.resize(b, eps_.size());
  if (b == 0) return;
  J_.setIdentity(b, b);
  factors_.solve_columns(J_);
  multiply_gradient(gradient_, excess_);
}

void LinearCoordinates::multiply_gradient(const PrestressGradient& gradient, MatrixX& product) const {
  const Eigen::Index b = rows();
  product.leftCols(b).noalias() = J_ * gradient.interfaces.transpose();
  product.rightCols(gradient.modes.rows()).noalias() = J_ * gradient.modes.transpose();
}

void LinearCoordinates::multiply(VectorX& v) const {
  const Eigen::Index b = rows(), m = v.size() - b;
  if (b == 0) return;
  add_transposed_product(v.head(b), gradient_.modes, v.tail(m));
  factors_.solve(v.head(b));
}

void LinearCoordinates::multiply_transposed(VectorX& v) const {
  const Eigen::Index b = rows(), m = v.size() - b;
  if (b == 0) return;
  factors_.solve_transposed(v.head(b));
  add_product(v.tail(m), gradient_.modes, v.head(b));
}

}  // namespace bielle::mechanism
