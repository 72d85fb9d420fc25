#include "reduce/mesh/selectors.hpp"

#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/patches.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

constexpr double least_cosine = 0.5;  // between the normals of a triangle and of the shape on which it lies

Eigen::Vector3d normal_of(const Eigen::Matrix3Xd& points, const Triangle& t) {
  return (points.col(t[1]) - points.col(t[0])).cross(points.col(t[2]) - points.col(t[0])).normalized();
}

Eigen::Vector3d radial_part(const Eigen::Vector3d& from_axis, const Eigen::Vector3d& axis) {
  return from_axis - axis * axis.dot(from_axis);
}

bool lies_on_shape(const CylinderSelector& cylinder, const Eigen::Matrix3Xd& points, const Triangle& triangle,
                   double tolerance) {
  const Eigen::Vector3d axis = cylinder.axis.normalized();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int node : triangle) {
    const Eigen::Vector3d radial = radial_part(points.col(node) - cylinder.point, axis);
    if (std::abs(radial.norm() - cylinder.radius) > tolerance) return false;
    middle += radial / 3;
  }
  return std::abs(normal_of(points, triangle).dot(middle.normalized())) > least_cosine;
}

bool lies_on_shape(const PlaneSelector& plane, const Eigen::Matrix3Xd& points, const Triangle& triangle,
                   double tolerance) {
  const Eigen::Vector3d normal = plane.normal.normalized();
  for (int node : triangle)
    if (std::abs(normal.dot(points.col(node) - plane.point)) > tolerance) return false;
  return std::abs(normal_of(points, triangle).dot(normal)) > least_cosine;
}

bool lies_on_shape(const BoxSelector& box, const Eigen::Matrix3Xd& points, const Triangle& triangle, double tolerance) {
  for (int node : triangle) {
    const Eigen::Array3d x = points.col(node).array();
    if ((x < box.low.array() - tolerance).any() || (x > box.high.array() + tolerance).any()) return false;
  }
  return true;
}

bool lies_on_shape(const std::string&, const Eigen::Matrix3Xd&, const Triangle&, double) { return false; }

}  // namespace

double selection_tolerance(const Eigen::Matrix3Xd& points) {
  return 1e-4 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

bool lies_on(const SurfaceSelector& shape, const Eigen::Matrix3Xd& points, const Triangle& triangle, double tolerance) {
  return std::visit([&](const auto& s) { return lies_on_shape(s, points, triangle, tolerance); }, shape);
}

std::string selector_name(const SurfaceSelector& shape) {
  if (const auto* cylinder = std::get_if<CylinderSelector>(&shape))
    return fmt::format("the cylinder with radius {:.5g} m about {} along {}", cylinder->radius,
                       place_name(cylinder->point), direction_name(cylinder->axis.normalized()));
  if (const auto* plane = std::get_if<PlaneSelector>(&shape))
    return fmt::format("the plane through {} normal to {}", place_name(plane->point),
                       direction_name(plane->normal.normalized()));
  if (const auto* box = std::get_if<BoxSelector>(&shape))
    return fmt::format("the box from {} to {}", place_name(box->low), place_name(box->high));
  return fmt::format("'{}'", std::get<std::string>(shape));
}

std::vector<int> select_triangles(const SurfaceSelector& shape, const Eigen::Matrix3Xd& points,
                                  const BodySurface& surface) {
  const double tolerance = selection_tolerance(points);
  const int count = static_cast<int>(surface.triangles.size());
  std::vector<char> inside(count);
  std::map<int, bool> whole;  // surface of the geometry -> all its triangles lie on the shape
  for (int i = 0; i < count; ++i) {
    inside[i] = lies_on(shape, points, surface.triangles[i], tolerance);
    if (!surface.geometry) continue;
    const auto entry = whole.emplace(surface.entities[i], true).first;
    entry->second = entry->second && inside[i];
  }
  std::vector<int> selected;
  for (int i = 0; i < count; ++i)
    if (inside[i] && (!surface.geometry || whole.at(surface.entities[i]))) selected.push_back(i);
  if (selected.empty())
    throw InputError(fmt::format("no surface of the body lies {} {} (within {:.2g} m){}",
                                 std::holds_alternative<BoxSelector>(shape) ? "in" : "on", selector_name(shape),
                                 tolerance, near_candidates(shape, points, surface)));
  return selected;
}

}  // namespace bielle::reduce
