#include "reduce/mesh/patches.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double feature_angle = 40 * std::numbers::pi / 180;
constexpr std::size_t most_candidates = 6;

// Number of the patch of each side.
std::vector<int> divide(const Matrix3Xd& points, const BodySurface& surface) {
  const int count = static_cast<int>(surface.sides.size());
  std::vector<int> patch(count);
  if (!surface.entities.empty()) {
    std::map<int, int> number;
    for (int i = 0; i < count; ++i)
      patch[i] = number.emplace(surface.entities[i], static_cast<int>(number.size())).first->second;
    return patch;
  }
  // Fills a patch across edges with two sides whose normals differ little.
  std::map<std::pair<int, int>, std::vector<int>> edges;
  std::vector<Vector3d> normals(count);
  for (int i = 0; i < count; ++i) {
    const Corners& t = surface.sides[i];
    normals[i] = area_vector(points, t).normalized();
    for (int k = 0; k < t.size(); ++k) edges[std::minmax(t[k], t[(k + 1) % t.size()])].push_back(i);
  }
  std::vector<std::vector<int>> neighbours(count);
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2 || normals[sides[0]].dot(normals[sides[1]]) < std::cos(feature_angle)) continue;
    neighbours[sides[0]].push_back(sides[1]);
    neighbours[sides[1]].push_back(sides[0]);
  }
  patch.assign(count, -1);
  int next = 0;
  for (int seed = 0; seed < count; ++seed) {
    if (patch[seed] >= 0) continue;
    std::vector<int> front{seed};
    patch[seed] = next;
    while (!front.empty()) {
      const int i = front.back();
      front.pop_back();
      for (int j : neighbours[i])
        if (patch[j] < 0) {
          patch[j] = next;
          front.push_back(j);
        }
    }
    ++next;
  }
  return patch;
}

void measure(const Matrix3Xd& points, const BodySurface& surface, double body_size, Patch& patch) {
  std::map<int, Vector3d> normal_at;  // node -> sum of area vectors
  patch.centre = Vector3d::Zero();
  for (int i : patch.sides) {
    const Corners& side = surface.sides[i];
    for (const auto& t : triangles_of(side)) {
      const double area = area_vector(points, t).norm();
      patch.area += area;
      patch.centre += area * (points.col(t[0]) + points.col(t[1]) + points.col(t[2])) / 3;
    }
    const Vector3d area = area_vector(points, side);
    for (int node : side) {
      normal_at.emplace(node, Vector3d::Zero()).first->second += area;
      patch.box.extend(Vector3d(points.col(node)));
    }
  }
  patch.centre /= patch.area;
  Matrix3Xd x(3, normal_at.size()), n(3, normal_at.size());
  Eigen::Index i = 0;
  for (const auto& [node, normal] : normal_at) {
    x.col(i) = points.col(node);
    n.col(i++) = normal.normalized();
  }
  // Nodes lie on their surface up to the digits of the file: 1e-6 of the coordinates, doubled.
  patch.shape = recognise_shape(x, n, std::max(1e-5 * patch.box.diagonal().norm(), 2e-6 * body_size));
  if (const auto* cylinder = std::get_if<CylinderShape>(&patch.shape); cylinder != nullptr && surface.outward) {
    const Vector3d from = x.col(0) - cylinder->point;
    patch.hollow = n.col(0).dot(from - cylinder->axis * cylinder->axis.dot(from)) < 0;
  }
}

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::min(1.0, std::abs(a.normalized().dot(b.normalized()))));
}

// Difference between a shape of the body and a requested one: the sum of relative differences; infinite for another
// kind.
double difference(const CylinderSelector& asked, const Patch& patch, double size) {
  const auto* c = std::get_if<CylinderShape>(&patch.shape);
  if (c == nullptr) return std::numeric_limits<double>::infinity();
  const Vector3d from = asked.point - c->point;
  return std::abs(c->radius - asked.radius) / std::max(asked.radius, c->radius) + angle_between(asked.axis, c->axis) +
         (from - c->axis * c->axis.dot(from)).norm() / size;
}

double difference(const PlaneSelector& asked, const Patch& patch, double size) {
  const auto* p = std::get_if<PlaneShape>(&patch.shape);
  if (p == nullptr) return std::numeric_limits<double>::infinity();
  return angle_between(asked.normal, p->normal) + std::abs(p->normal.dot(asked.point - p->point)) / size;
}

// Distance by which the patch extends beyond the box.
double difference(const BoxSelector& asked, const Patch& patch, double size) {
  const double below = (asked.low - patch.box.min()).maxCoeff(), above = (patch.box.max() - asked.high).maxCoeff();
  return std::max({below, above, 0.0}) / size;
}

double difference(const ShapeSelector& asked, const Patch& patch, double size) {
  double sum = 0;
  if (asked.cylinder) sum += difference(*asked.cylinder, patch, size);
  if (asked.plane) sum += difference(*asked.plane, patch, size);
  if (asked.box) sum += difference(*asked.box, patch, size);
  return sum;
}

std::string described(const ShapeSelector& asked, const Patch& patch) {
  if (asked.box)
    return fmt::format("a {} from {} to {}", shape_kind(patch.shape), place_name(patch.box.min()),
                       place_name(patch.box.max()));
  return shape_name(patch.shape) + (patch.hollow ? " (a bore)" : "");
}

}  // namespace

std::vector<Patch> find_patches(const Matrix3Xd& points, const BodySurface& surface) {
  std::map<int, Patch> numbered;
  const std::vector<int> patch_of = divide(points, surface);
  for (std::size_t i = 0; i < patch_of.size(); ++i) {
    Patch& patch = numbered[patch_of[i]];
    patch.sides.push_back(static_cast<int>(i));
    if (!surface.entities.empty()) patch.entity = surface.entities[i];
  }
  const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  std::vector<Patch> patches;
  for (auto& [number, patch] : numbered) {
    measure(points, surface, size, patch);
    patches.push_back(std::move(patch));
  }
  std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) { return a.area > b.area; });
  return patches;
}

std::string near_candidates(const ShapeSelector& shape, const Matrix3Xd& points, const BodySurface& surface) {
  const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  std::vector<std::pair<double, std::string>> candidates;
  for (const Patch& patch : find_patches(points, surface)) {
    const double unlike = difference(shape, patch, size);
    if (!std::isfinite(unlike)) continue;
    const std::string name = described(shape, patch);
    const bool known =
        std::any_of(candidates.begin(), candidates.end(), [&](const auto& c) { return c.second == name; });
    if (!known) candidates.emplace_back(unlike, name);
  }
  const bool box = shape.box.has_value();
  const char* kind = shape.cylinder ? "cylinders" : shape.plane ? "planes" : "surfaces";
  if (candidates.empty()) return fmt::format("; it has no {}", kind);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text =
      fmt::format("; {}the nearest {} are: ", box ? "a surface must lie in the box as a whole; " : "", kind);
  for (std::size_t i = 0; i < std::min(candidates.size(), most_candidates); ++i)
    text += (i == 0 ? "" : "; ") + candidates[i].second;
  return text;
}

}  // namespace bielle::reduce
