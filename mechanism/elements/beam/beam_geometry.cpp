#include "mechanism/elements/beam/beam_geometry.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace bielle::mechanism {

BeamLine BeamLine::straight(const Vector3& start, const Vector3& end) {
  BeamLine line;
  line.start_ = start;
  line.along_ = end - start;
  return line;
}

BeamLine BeamLine::arc(const Vector3& start, const Vector3& centre, const Vector3& axis, double angle) {
  BeamLine line;
  line.start_ = start;
  line.centre_ = centre;
  line.axis_ = axis;
  line.angle_ = angle;
  return line;
}

Vector3 BeamLine::point(double s) const {
  if (angle_ == 0) return start_ + s * along_;
  return centre_ + exp_so3(s * angle_ * axis_) * (start_ - centre_);
}

Vector3 BeamLine::start_tangent() const {
  return angle_ == 0 ? along_.normalized() : axis_.cross(start_ - centre_).normalized();
}

double BeamLine::length() const { return angle_ == 0 ? along_.norm() : angle_ * (start_ - centre_).norm(); }

Frame BeamLine::frame(double s, const Matrix3& R_start, double twist) const {
  return {point(s), exp_so3(s * angle_ * axis_) * R_start * exp_so3(Vector3(s * twist, 0, 0))};
}

Vector6 BeamLine::rate(double s, const Matrix3& R_start, double twist) const {
  Vector6 d;
  d << length(), 0, 0, frame(s, R_start, twist).R.transpose() * (angle_ * axis_) + Vector3(twist, 0, 0);
  return d;
}

namespace {

/// Two points closer than this fraction of the scale of the figure are considered equal.
constexpr double coincident = 1e-9;

BeamLine arc_about(const YamlValue& value, const Vector3& start, const Vector3& end) {
  const Vector3 given = value.vector3();
  const double r_a = (start - given).norm(), r_b = (end - given).norm();
  // Coordinates in input files are rounded; the centre is moved so that both ends are exactly on one circle.
  if (std::abs(r_a - r_b) > 1e-5 * std::max(r_a, r_b))
    value.fail(
        fmt::format("the ends are not at one distance from the centre of the arc: {:.9g} m and {:.9g} m; three points "
                    "always lie on a circle: see `arc_through`",
                    r_a, r_b));
  const Vector3 chord = end - start, middle = 0.5 * (start + end);
  const Vector3 centre = given - chord * (chord.dot(given - middle) / chord.squaredNorm());
  const Vector3 normal = (start - centre).cross(end - centre);
  constexpr double flat = 1e-6;
  if (normal.norm() <= flat * r_a * r_a && (start - centre).dot(end - centre) > 0)
    value.fail(
        fmt::format("about this centre, {:.3g} m away, the arc turns by less than {:.0e} rad: leave it out for a "
                    "straight beam",
                    r_a, flat));
  if (normal.norm() <= flat * r_a * r_a)
    value.fail("a half circle about a centre lies in no definite plane: give a point on it by `arc_through` instead");
  const double angle = std::atan2(normal.norm(), (start - centre).dot(end - centre));
  return BeamLine::arc(start, centre, normal.normalized(), angle);
}

BeamLine arc_through(const YamlValue& value, const Vector3& start, const Vector3& end) {
  const Vector3 through = value.vector3();
  const Vector3 p = through - start, q = end - start;
  const Vector3 n = p.cross(q);
  const double scale = std::max(p.norm(), q.norm());
  if (n.norm() <= coincident * scale * scale)
    value.fail("the ends and the point of the arc lie in one line: leave `arc_through` out for a straight beam");
  // Centre of the circle through three points.
  const Vector3 centre = start + (p.squaredNorm() * q.cross(n) + q.squaredNorm() * n.cross(p)) / (2 * n.squaredNorm());
  const Vector3 axis = n.normalized();
  const Vector3 from = start - centre;
  const auto angle_to = [&](const Vector3& point) {
    const Vector3 to = point - centre;
    const double angle = std::atan2(axis.dot(from.cross(to)), from.dot(to));
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
  };
  // The rotation about +n leads from `start` through the second point to `end`.
  return BeamLine::arc(start, centre, axis, angle_to(end));
}

}  // namespace

BeamLine read_beam_line(const YamlValue& entry, const Vector3& start, const Vector3& end) {
  const auto centre = entry.find("arc_centre"), through = entry.find("arc_through");
  if (centre && through) through->fail("give either `arc_centre` or `arc_through`");
  if ((end - start).norm() <= coincident * std::max(start.norm(), end.norm()))
    entry.at("nodes").fail(centre || through
                               ? "both ends of the beam are at the same place: make a full circle of two arcs or more"
                               : "both ends of the beam are at the same place");
  if (centre) return arc_about(*centre, start, end);
  if (through) return arc_through(*through, start, end);
  return BeamLine::straight(start, end);
}

Matrix3 read_start_axes(const YamlValue& entry, const Vector3& tangent) {
  Vector3 y = Vector3::UnitX();
  if (const auto orientation = entry.find("orientation")) {
    y = orientation->direction();
    if (y.cross(tangent).norm() < 1e-6)
      orientation->fail("the orientation is parallel to the beam's axis at the start");
  } else {
    for (int k = 1; k < 3; ++k)
      if (std::abs(tangent[k]) < std::abs(tangent.dot(y)) - 1e-9) y = Vector3::Unit(k);
  }
  y = (y - tangent * tangent.dot(y)).normalized();
  Matrix3 R;
  R << tangent, y, tangent.cross(y);
  return R;
}

}  // namespace bielle::mechanism
