#include "reduce/mesh/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Eigen::Index least_points = 9;  // more than any shape has parameters

// The sense of an axis is arbitrary: its largest component is made positive.
Vector3d positive(const Vector3d& axis) {
  Eigen::Index largest;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? Vector3d(-axis) : axis;
}

Vector3d least_eigenvector(const Matrix3d& symmetric) { return symmetric_eigenpairs(symmetric).vectors.col(0); }

Matrix3d covariance(const Matrix3Xd& x) {
  const Matrix3Xd centred = x.colwise() - x.rowwise().mean();
  return centred * centred.transpose();
}

// Distances of all points from a shape with the given parameters.
using Residual = std::function<VectorXd(const VectorXd&)>;

// Gauss-Newton with Levenberg's damping and central differences: at most 8 parameters, lengths of order one.
VectorXd refine(const Residual& residual, VectorXd parameters) {
  VectorXd r = residual(parameters);
  double damping = 1e-4;
  for (int iteration = 0; iteration < 60; ++iteration) {
    Eigen::MatrixXd jacobian(r.size(), parameters.size());
    for (Eigen::Index k = 0; k < parameters.size(); ++k) {
      constexpr double step = 1e-6;
      VectorXd ahead = parameters, behind = parameters;
      ahead[k] += step;
      behind[k] -= step;
      jacobian.col(k) = (residual(ahead) - residual(behind)) / (2 * step);
    }
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() += VectorXd::Constant(parameters.size(), damping * normal.diagonal().maxCoeff() + 1e-300);
    const VectorXd change = -solve_symmetric(normal, jacobian.transpose() * r);
    const VectorXd trial = residual(parameters + change);
    if (!trial.allFinite() || !(trial.squaredNorm() < r.squaredNorm())) {
      damping *= 10;
      if (damping > 1e6) break;
      continue;
    }
    parameters += change;
    r = trial;
    damping = std::max(damping / 10, 1e-14);
    if (change.norm() < 1e-15) break;
  }
  return parameters;
}

VectorXd radii(const Matrix3Xd& x, const Vector3d& point, const Vector3d& axis) {
  const Matrix3Xd from = x.colwise() - point;
  return (from - axis * (axis.transpose() * from)).colwise().norm().transpose();
}

VectorXd heights(const Matrix3Xd& x, const Vector3d& point, const Vector3d& axis) {
  return (axis.transpose() * (x.colwise() - point)).transpose();
}

// Each fit works on points with mean 0 and size 1. Order of the parameters: points, then axes of any length, then radii
// and angles.
struct Samples {
  Matrix3Xd x, n;
  double tolerance;
  bool fits(const VectorXd& residual) const { return residual.cwiseAbs().maxCoeff() <= tolerance; }
};

std::optional<PlaneShape> fit_plane(const Samples& s) {
  const Vector3d normal = least_eigenvector(covariance(s.x));
  if (!s.fits(heights(s.x, Vector3d::Zero(), normal))) return {};
  return PlaneShape{Vector3d::Zero(), positive(normal)};
}

std::optional<CylinderShape> fit_cylinder(const Samples& s) {
  const Vector3d axis = least_eigenvector(s.n * s.n.transpose());
  // Circle through the projections: |y|^2 = 2 c.y + k, linear in c and k.
  const Matrix3Xd y = s.x - axis * (axis.transpose() * s.x);
  Eigen::MatrixXd system(y.cols(), 4);
  system << 2 * y.transpose(), VectorXd::Ones(y.cols());
  const VectorXd circle = least_squares(system, y.colwise().squaredNorm().transpose());
  VectorXd start(7);
  start << circle.head<3>(), axis, std::sqrt(std::max(circle[3] + circle.head<3>().squaredNorm(), 1e-6));
  const Residual residual = [&](const VectorXd& p) {
    return VectorXd(radii(s.x, p.head<3>(), p.segment<3>(3).normalized()).array() - p[6]);
  };
  const VectorXd p = refine(residual, start);
  if (!s.fits(residual(p))) return {};
  const Vector3d a = p.segment<3>(3).normalized();
  const VectorXd along = heights(s.x, p.head<3>(), a);
  const double middle = (along.minCoeff() + along.maxCoeff()) / 2;
  return CylinderShape{p.head<3>() + middle * a, positive(a), std::abs(p[6])};
}

std::optional<SphereShape> fit_sphere(const Samples& s) {
  Eigen::MatrixXd system(s.x.cols(), 4);
  system << 2 * s.x.transpose(), VectorXd::Ones(s.x.cols());
  const VectorXd p = least_squares(system, s.x.colwise().squaredNorm().transpose());
  const double radius = std::sqrt(std::max(p[3] + p.head<3>().squaredNorm(), 0.0));
  const VectorXd distance = (s.x.colwise() - p.head<3>()).colwise().norm().transpose();
  if (!s.fits(VectorXd(distance.array() - radius))) return {};
  return SphereShape{p.head<3>(), radius};
}

std::optional<ConeShape> fit_cone(const Samples& s) {
  // Normals are tangent to a cone about the axis; all tangent planes pass through the apex.
  Matrix3Xd n = s.n;
  Vector3d axis = least_eigenvector(covariance(n));
  const Vector3d apex = least_squares(n.transpose(), n.cwiseProduct(s.x).colwise().sum().transpose());
  if (heights(s.x, apex, axis).mean() < 0) axis = -axis;
  const Residual residual = [&](const VectorXd& p) {
    const Vector3d a = p.segment<3>(3).normalized();
    return VectorXd(radii(s.x, p.head<3>(), a) * std::cos(p[6]) - heights(s.x, p.head<3>(), a) * std::sin(p[6]));
  };
  VectorXd start(7);
  start << apex, axis, std::atan2(radii(s.x, apex, axis).mean(), heights(s.x, apex, axis).mean());
  if (!start.allFinite()) return {};
  const VectorXd p = refine(residual, start);
  if (!s.fits(residual(p)) || p[6] <= 0 || p[6] >= std::numbers::pi / 2) return {};
  const Vector3d a = p.segment<3>(3).normalized();
  if (heights(s.x, p.head<3>(), a).minCoeff() < -s.tolerance) return {};
  return ConeShape{p.head<3>(), a, p[6]};
}

std::optional<TorusShape> fit_torus(const Samples& s) {
  // Normals x + t n meet the axis (point c, direction a): a.(x cross n) + (c cross a).n = 0, linear in a and c cross a.
  Eigen::MatrixXd system(s.x.cols(), 6);
  for (Eigen::Index i = 0; i < s.x.cols(); ++i)
    system.row(i) << s.x.col(i).cross(s.n.col(i)).transpose(), s.n.col(i).transpose();
  const VectorXd line = right_singular_vectors(system).vectors.col(5);
  const double length = line.head<3>().norm();
  if (length < 1e-6) return {};
  const Vector3d axis = line.head<3>() / length;
  const Vector3d point = axis.cross(line.tail<3>() / length);
  // Circle in the meridian half-plane: (rho - R)^2 + (z - h)^2 = r^2, linear in R, h and a constant.
  const VectorXd rho = radii(s.x, point, axis), z = heights(s.x, point, axis);
  Eigen::MatrixXd circle(s.x.cols(), 3);
  circle << 2 * rho, 2 * z, VectorXd::Ones(s.x.cols());
  const Vector3d c = least_squares(circle, rho.cwiseAbs2() + z.cwiseAbs2());
  VectorXd start(8);
  start << point + c[1] * axis, axis, c[0], std::sqrt(std::max(c[2] + c[0] * c[0] + c[1] * c[1], 1e-6));
  const Residual residual = [&](const VectorXd& p) {
    const Vector3d a = p.segment<3>(3).normalized();
    const Eigen::ArrayXd away = radii(s.x, p.head<3>(), a).array() - p[6];
    return VectorXd((away.square() + heights(s.x, p.head<3>(), a).array().square()).sqrt() - p[7]);
  };
  const VectorXd p = refine(residual, start);
  if (!s.fits(residual(p)) || p[6] <= 0) return {};
  return TorusShape{p.head<3>(), positive(p.segment<3>(3).normalized()), p[6], std::abs(p[7])};
}

// Converts the samples' coordinates (mean 0, size 1) to the body's.
struct Restore {
  Vector3d mean;
  double scale;
  Vector3d point(const Vector3d& x) const { return mean + scale * x; }
  Shape operator()(const PlaneShape& p) const { return PlaneShape{point(p.point), p.normal}; }
  Shape operator()(const CylinderShape& c) const { return CylinderShape{point(c.point), c.axis, scale * c.radius}; }
  Shape operator()(const ConeShape& c) const { return ConeShape{point(c.apex), c.axis, c.half_angle}; }
  Shape operator()(const SphereShape& b) const { return SphereShape{point(b.centre), scale * b.radius}; }
  Shape operator()(const TorusShape& t) const {
    return TorusShape{point(t.centre), t.axis, scale * t.major_radius, scale * t.minor_radius};
  }
};

}  // namespace

Shape recognise_shape(const Matrix3Xd& points, const Matrix3Xd& normals, double tolerance) {
  if (points.cols() == 0) return {};
  const Restore restore{points.rowwise().mean(),
                        std::max((points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm(), 1e-300)};
  const Samples samples{(points.colwise() - restore.mean) / restore.scale, normals, tolerance / restore.scale};
  if (const auto plane = fit_plane(samples)) return restore(*plane);
  if (points.cols() < least_points) return {};
  if (const auto cylinder = fit_cylinder(samples)) return restore(*cylinder);
  if (const auto sphere = fit_sphere(samples)) return restore(*sphere);
  if (const auto cone = fit_cone(samples)) return restore(*cone);
  if (const auto torus = fit_torus(samples)) return restore(*torus);
  return {};
}

std::string shape_kind(const Shape& shape) {
  static const char* const kinds[] = {"free form", "plane", "cylinder", "cone", "sphere", "torus"};
  return kinds[shape.index()];
}

std::string shape_name(const Shape& shape) {
  const std::string kind = shape_kind(shape);
  if (const auto* p = std::get_if<PlaneShape>(&shape))
    return fmt::format("{} through {} normal to {}", kind, place_name(p->point), direction_name(p->normal));
  if (const auto* c = std::get_if<CylinderShape>(&shape))
    return fmt::format("{} with radius {:.5g} m about {} along {}", kind, c->radius, place_name(c->point),
                       direction_name(c->axis));
  if (const auto* c = std::get_if<ConeShape>(&shape))
    return fmt::format("{} of half angle {:.4g} degrees, apex {}, axis {}", kind,
                       c->half_angle * 180 / std::numbers::pi, place_name(c->apex), direction_name(c->axis));
  if (const auto* b = std::get_if<SphereShape>(&shape))
    return fmt::format("{} with radius {:.5g} m about {}", kind, b->radius, place_name(b->centre));
  if (const auto* t = std::get_if<TorusShape>(&shape))
    return fmt::format("{} with radii {:.5g} and {:.5g} m about {}, axis {}", kind, t->major_radius, t->minor_radius,
                       place_name(t->centre), direction_name(t->axis));
  return kind;
}

}  // namespace bielle::reduce
