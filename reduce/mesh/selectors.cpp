#include "reduce/mesh/selectors.hpp"

#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/patches.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

constexpr double least_cosine = 0.5;  // between the normals of a side and of the shape on which it lies

Eigen::Vector3d normal_of(const Eigen::Matrix3Xd& points, const Corners& side) {
  return area_vector(points, side).normalized();
}

Eigen::Vector3d radial_part(const Eigen::Vector3d& from_axis, const Eigen::Vector3d& axis) {
  return from_axis - axis * axis.dot(from_axis);
}

bool lies_on_shape(const CylinderSelector& cylinder, const Eigen::Matrix3Xd& points, const Corners& side,
                   double tolerance) {
  const Eigen::Vector3d axis = cylinder.axis.normalized();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int node : side) {
    const Eigen::Vector3d radial = radial_part(points.col(node) - cylinder.point, axis);
    if (std::abs(radial.norm() - cylinder.radius) > tolerance) return false;
    middle += radial / side.size();
  }
  return std::abs(normal_of(points, side).dot(middle.normalized())) > least_cosine;
}

bool lies_on_shape(const PlaneSelector& plane, const Eigen::Matrix3Xd& points, const Corners& side, double tolerance) {
  const Eigen::Vector3d normal = plane.normal.normalized();
  for (int node : side)
    if (std::abs(normal.dot(points.col(node) - plane.point)) > tolerance) return false;
  return std::abs(normal_of(points, side).dot(normal)) > least_cosine;
}

bool lies_on_shape(const BoxSelector& box, const Eigen::Matrix3Xd& points, const Corners& side, double tolerance) {
  for (int node : side) {
    const Eigen::Array3d x = points.col(node).array();
    if ((x < box.low.array() - tolerance).any() || (x > box.high.array() + tolerance).any()) return false;
  }
  return true;
}

}  // namespace

double selection_tolerance(const Eigen::Matrix3Xd& points) {
  return 1e-4 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

bool lies_on(const ShapeSelector& shape, const Eigen::Matrix3Xd& points, const Corners& side, double tolerance) {
  return (!shape.cylinder || lies_on_shape(*shape.cylinder, points, side, tolerance)) &&
         (!shape.plane || lies_on_shape(*shape.plane, points, side, tolerance)) &&
         (!shape.box || lies_on_shape(*shape.box, points, side, tolerance));
}

std::string selector_name(const ShapeSelector& shape) {
  std::vector<std::string> names;
  if (shape.cylinder)
    names.push_back(fmt::format("on the cylinder with radius {:.5g} m about {} along {}", shape.cylinder->radius,
                                place_name(shape.cylinder->point), direction_name(shape.cylinder->axis.normalized())));
  if (shape.plane)
    names.push_back(fmt::format("on the plane through {} normal to {}", place_name(shape.plane->point),
                                direction_name(shape.plane->normal.normalized())));
  if (shape.box)
    names.push_back(fmt::format("in the box from {} to {}", place_name(shape.box->low), place_name(shape.box->high)));
  return fmt::format("{}", fmt::join(names, " and "));
}

std::vector<int> select_sides(const ShapeSelector& shape, const Eigen::Matrix3Xd& points, const BodySurface& surface) {
  const double tolerance = selection_tolerance(points);
  const int count = static_cast<int>(surface.sides.size());
  std::vector<char> inside(count);
  std::map<int, bool> whole;  // surface of the geometry -> all its sides lie on the shape
  for (int i = 0; i < count; ++i) {
    inside[i] = lies_on(shape, points, surface.sides[i], tolerance);
    if (!surface.geometry) continue;
    const auto entry = whole.emplace(surface.entities[i], true).first;
    entry->second = entry->second && inside[i];
  }
  std::vector<int> selected;
  for (int i = 0; i < count; ++i)
    if (inside[i] && (!surface.geometry || whole.at(surface.entities[i]))) selected.push_back(i);
  if (selected.empty())
    throw InputError(fmt::format("no surface of the body lies {} (within {:.2g} m){}", selector_name(shape), tolerance,
                                 near_candidates(shape, points, surface)));
  return selected;
}

}  // namespace bielle::reduce
