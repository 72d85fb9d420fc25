#include "mechanism/elements/beam/section_outline.hpp"

#include <cmath>
#include <numbers>

#include "mechanism/elements/beam/section_shape.hpp"

namespace bielle::mechanism {
namespace {

DrawnOutline circle_outline(double radius) {
  constexpr int sides = 32;
  DrawnOutline outline;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

DrawnOutline rectangle_outline(double y0, double y1, double z0, double z1) {
  return {{y0, z0}, {y1, z0}, {y1, z1}, {y0, z1}};
}

/// Returns the outline of rectangles that stand on each other: up along their right sides, down along their left sides.
DrawnOutline stack_outline(const std::vector<SectionRectangle>& stack) {
  DrawnOutline outline;
  for (const SectionRectangle& each : stack) {
    outline.push_back({each.y1, each.z0});
    outline.push_back({each.y1, each.z1});
  }
  for (auto each = stack.rbegin(); each != stack.rend(); ++each) {
    outline.push_back({each->y0, each->z1});
    outline.push_back({each->y0, each->z0});
  }
  return outline;
}

/// Returns the walls of a box: below, above, left, right.
DrawnSection box_outline(const std::vector<SectionRectangle>& walls) {
  const SectionRectangle &below = walls[0], &above = walls[1], &left = walls[2], &right = walls[3];
  return {0, rectangle_outline(below.y0, below.y1, below.z0, above.z1),
          rectangle_outline(left.y1, right.y0, below.z1, above.z0)};
}

DrawnSection centred_outline(const std::string& shape, const VectorX& d) {
  if (shape == "rectangle") return {0, rectangle_outline(-d[0] / 2, d[0] / 2, -d[1] / 2, d[1] / 2)};
  if (shape == "circle") return {0, circle_outline(d[0])};
  if (shape == "tube") return {0, circle_outline(d[0]), d[1] > 0 ? circle_outline(d[1]) : DrawnOutline{}};
  const RectangleArea area = wall_area(shape, d);
  return shape == "box" ? box_outline(area.rectangles) : DrawnSection{0, stack_outline(area.rectangles)};
}

}  // namespace

DrawnSection section_outline(const std::string& shape, const VectorX& dimensions, const Vector2& offset) {
  DrawnSection section = centred_outline(shape, dimensions);
  for (DrawnOutline* outline : {&section.outer, &section.inner})
    for (std::array<double, 2>& point : *outline) point = {point[0] + offset[0], point[1] + offset[1]};
  return section;
}

}  // namespace bielle::mechanism
