#include "mechanism/contacts/shape.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

using Kind = ContactShape::Kind;
constexpr std::array<Kind, 6> all_kinds = {Kind::sphere,   Kind::plane, Kind::capsule,
                                           Kind::cylinder, Kind::box,   Kind::surface};

const char* name_of_kind(Kind kind) {
  static constexpr std::array<const char*, 6> names = {"sphere", "plane", "capsule", "cylinder", "box", "surface"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace

const char* ContactShape::kind_name() const { return name_of_kind(kind); }

double ContactShape::skin() const {
  switch (kind) {
    case Kind::sphere:
    case Kind::capsule:
      return radius;
    case Kind::box:
    case Kind::cylinder:
      return rounding;
    default:
      return 0;
  }
}

Vector3 ContactShape::middle() const { return kind == Kind::surface ? surface->middle() : Vector3::Zero(); }

double ContactShape::reach() const {
  switch (kind) {
    case Kind::sphere:
      return radius;
    case Kind::capsule:
      return half_length + radius;
    case Kind::cylinder:
      return std::hypot(half_length, radius);
    case Kind::box:
      return half.norm();
    case Kind::surface:
      return surface->reach();
    default:
      return std::numeric_limits<double>::infinity();
  }
}

double ContactShape::thickness() const {
  switch (kind) {
    case Kind::sphere:
    case Kind::capsule:
      return 2 * radius;
    case Kind::cylinder:
      return 2 * std::min(radius, half_length);
    case Kind::box:
      return 2 * half.minCoeff();
    case Kind::surface:
      return 0;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

Vector3 ContactShape::half_extent() const {
  switch (kind) {
    case Kind::capsule:
      return {radius, radius, half_length + radius};
    case Kind::cylinder:
      return {radius, radius, half_length};
    case Kind::box:
      return half;
    default:
      return Vector3::Constant(reach());
  }
}

double ContactShape::dome_height() const {
  constexpr double share = 0.01;
  return std::min(share * dome_radius(), half_length - rounding);
}

void ContactShape::complete() {
  if (kind == Kind::sphere) corners_ = {Vector3::Zero()};
  if (kind == Kind::capsule || kind == Kind::cylinder) {
    const double end = kind == Kind::capsule ? half_length : half_length - rounding - dome_height();
    corners_ = {{0, 0, -end}, {0, 0, end}};
    edges_ = {{0, 1}};
  }
  if (kind != Kind::box) return;
  const Vector3 core = half - Vector3::Constant(rounding);
  for (int k = 0; k < 8; ++k)
    corners_.emplace_back((k & 1 ? 1 : -1) * core.x(), (k & 2 ? 1 : -1) * core.y(), (k & 4 ? 1 : -1) * core.z());
  for (int k = 0; k < 8; ++k)
    for (const int bit : {1, 2, 4})
      if ((k & bit) == 0) edges_.push_back({k, k | bit});
}

std::string ContactShape::describe() const {
  std::string text = fmt::format("{} on '{}'", kind_name(), node_name);
  switch (kind) {
    case Kind::sphere:
      return text + fmt::format(", radius {:.6g} m", radius);
    case Kind::capsule:
      return text + fmt::format(", radius {:.6g} m, {:.6g} m between its ends", radius, 2 * (half_length + radius));
    case Kind::cylinder:
      return text + fmt::format(", radius {:.6g} m, length {:.6g} m, rims rounded by {:.3g} m", radius, 2 * half_length,
                                rounding);
    case Kind::box:
      return text + fmt::format(", {:.6g} x {:.6g} x {:.6g} m, edges rounded by {:.3g} m", 2 * half.x(), 2 * half.y(),
                                2 * half.z(), rounding);
    case Kind::surface:
      return text + fmt::format(
                        ", {} triangles, {:.6g} m from end to end, {}", surface->triangles().size(), surface->size(),
                        surface->open_edges() == 0 ? "closed" : fmt::format("open at {} edges", surface->open_edges()));
    default:
      return text;
  }
}

bool can_touch(Kind a, Kind b) { return a != b || (a != Kind::plane && a != Kind::surface); }

std::string touchable_kinds(Kind kind) {
  std::string text;
  for (const Kind other : all_kinds)
    if (can_touch(kind, other)) text += fmt::format("{}{}", text.empty() ? "" : ", ", name_of_kind(other));
  return text;
}

}  // namespace bielle::mechanism
