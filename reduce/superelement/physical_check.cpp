#include "reduce/superelement/physical_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "reduce/dense/symmetric_factors.hpp"
#include "reduce/superelement/superelement.hpp"
#include "reduce/superelement/superelement_check.hpp"

namespace bielle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Least eigenvalue of a semidefinite matrix relative to its largest entry, with coordinates scaled to unit mass, that
/// counts as rounding.
constexpr double rounding = 1e-8;
/// Tolerance for the stiffness of a mode: frequencies may be written with few digits.
constexpr double frequency_digits = 1e-3;

/// @param scale  scale of each coordinate
bool is_semidefinite(const MatrixXd& matrix, const VectorXd& scale) {
  MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  scaled = MatrixXd(0.5 * (scaled + scaled.transpose()));
  const double largest = scaled.cwiseAbs().maxCoeff();
  if (!std::isfinite(largest)) return false;
  if (largest == 0) return true;
  scaled /= largest;
  scaled.diagonal().array() += rounding * static_cast<double>(scaled.rows());
  return is_positive_definite(scaled);
}

double square_of_omega(double frequency) { return std::pow(2 * std::numbers::pi * frequency, 2); }

/// Describes the first mode whose stiffness does not match its frequency; empty if there is none.
std::string odd_mode(const Superelement& body) {
  const Index first = body.interface_directions();
  for (Index k = 0; k < body.modes(); ++k) {
    const double found = body.stiffness(first + k, first + k) / body.mass(first + k, first + k);
    const double wanted = square_of_omega(body.frequencies[k]);
    if (std::abs(found - wanted) <= frequency_digits * wanted) continue;
    return fmt::format(
        "/reduced/stiffness: mode {} has {:.6g} Hz by its stiffness and mass, and {:.6g} Hz in /modes/frequencies",
        k + 1, std::sqrt(std::max(0.0, found)) / (2 * std::numbers::pi), body.frequencies[k]);
  }
  return "";
}

}  // namespace

std::string physical_fault_of(const Superelement& body) {
  if (!(body.mass.diagonal().minCoeff() > 0)) return "/reduced/mass: is not positive definite";
  const VectorXd scale = body.mass.diagonal().cwiseSqrt().cwiseInverse();
  if (!is_positive_definite(scale.asDiagonal() * body.mass * scale.asDiagonal()))
    return "/reduced/mass: is not positive definite";
  if (!is_semidefinite(body.stiffness, scale))
    return "/reduced/stiffness: is not positive: some deformation would release energy";
  if (!is_semidefinite(body.damping, scale))
    return "/reduced/damping: is not positive: some motion would gain energy from it";
  for (std::size_t k = 0; k < 3; ++k)
    if (!is_semidefinite(body.inertia_components[k], scale))
      return fmt::format("/reduced/inertia_components: the {} is not positive", k == 0   ? "first"
                                                                                : k == 1 ? "second"
                                                                                         : "third");
  if (!is_semidefinite(body.inertia, Eigen::Vector3d::Ones())) return "/mass_properties/inertia: is not positive";
  return odd_mode(body);
}

std::string first_fault_of(const Superelement& body) {
  const std::string fault = fault_of(body);
  return fault.empty() ? physical_fault_of(body) : fault;
}

}  // namespace bielle
