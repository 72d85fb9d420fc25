// Gears, wheels, cams, belts and cables as they are drawn.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mechanism/drawing/drawn_model.hpp"

namespace test_drawn_wheels {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Detail::Approx;

constexpr double pi = std::numbers::pi;

/// Bodies on hinges about y.
std::string wheels(const std::string& first, const std::string& second) {
  std::string text = "nodes: {a: {position: " + first + ", rotation_vector: [0.3, 0.2, 0.1]}, b: {position: " + second +
                     "}}\nelements:\n";
  for (const char* node : {"a", "b"})
    text += fmt::format("  {0}: {{type: rigid_body, node: {0}, mass: 1, inertia: [1, 1, 1]}}\n", node);
  return text +
         "joints:\n"
         "  pin_a: {type: hinge, nodes: [ground, a], axis: [0, 1, 0]}\n"
         "  pin_b: {type: hinge, nodes: [ground, b], axis: [0, 1, 0]}\n";
}

/// Returns the distance of a point from the axis of an item, and along it.
std::array<double, 2> about_axis(const Frame& frame, const Vector3& point) {
  const Vector3 way = frame.R.transpose() * (point - frame.x);
  return {way.head<2>().norm(), way.z()};
}

TEST_CASE("gears in mesh touch where the teeth meet") {
  struct Case {
    const char *second, *keys;
    Vector3 P;
    std::array<double, 2> radius;
    std::array<bool, 2> inner;
  };
  const std::vector<Case> cases = {
      {"[0.3, 0, 0]", "axes: [0, 1, 0], radii: [0.1, 0.2]", {0.1, 0, 0}, {0.1, 0.2}, {false, false}},
      {"[0.3, 0.4, 0]", "axes: [0, 1, 0], radii: [0.1, 0.2]", {0.1, 0.2, 0}, {0.1, 0.2}, {false, false}},
      {"[0.1, 0, 0]", "axes: [0, 1, 0], radii: [0.3, 0.2], internal: true", {0.3, 0, 0}, {0.3, 0.2}, {true, false}},
      {"[0.1, 0, 0]", "axes: [0, 1, 0], radii: [0.2, 0.3], internal: true", {-0.2, 0, 0}, {0.2, 0.3}, {false, true}}};
  for (const Case& each : cases) {
    CAPTURE(each.keys, each.second);
    const DrawnModel drawn(wheels("[0, 0, 0]", each.second) + "  it: {type: gear_mesh, nodes: [a, b], " + each.keys +
                           "}\n");
    const auto gears = drawn.all("joints/it", "gear");
    REQUIRE(gears.size() == 2);
    for (const std::size_t k : {0, 1}) {
      CHECK(number_of(*gears[k], "radius") == Approx(each.radius[k]));
      CHECK(value_of<bool>(*gears[k], "inner") == each.inner[k]);
      const auto [radial, axial] = about_axis(drawn.at(*gears[k]), each.P);
      CHECK(radial == Approx(each.radius[k]));
      CHECK(axial == Approx(0).margin(1e-13));
      CHECK(drawn.at(*gears[k]).R.col(2).isApprox(Vector3(0, 1, 0), 1e-13));
    }
  }
}

TEST_CASE("a pinion is drawn about its bearing") {
  const DrawnModel drawn(
      "nodes: {a: {}, b: {position: [0, 0, -0.1]}}\n"
      "elements: {a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}, b: {type: rigid_body, node: b, mass: 1, "
      "inertia: [1, 1, 1]}}\n"
      "joints:\n"
      "  it: {type: rack_and_pinion, joints: [bearing, guide], radius: -0.1}\n"
      "  bearing: {type: hinge, nodes: [ground, a], axis: [0, 1, 0]}\n"
      "  guide: {type: prismatic, nodes: [ground, b], axis: [1, 0, 0]}\n");
  const DrawnItem& gear = drawn.one("joints/it", "gear");
  CHECK(number_of(gear, "radius") == 0.1);
  CHECK(gear.type == "rack_and_pinion");
  CHECK(drawn.at(gear).R.col(2).isApprox(Vector3(0, 1, 0), 1e-13));
}

TEST_CASE("a wheel stands on its plane") {
  const DrawnModel drawn(
      "nodes: {hub: {position: [1, 2, 0.3]}}\n"
      "elements: {m: {type: rigid_body, node: hub, mass: 1, inertia: [1, 1, 1]}}\n"
      "joints: {it: {type: wheel, nodes: [ground, hub], normal: [0, 0, 1], axis: [0, 1, 0], radius: 0.3}}\n");
  const DrawnItem &tyre = drawn.one("joints/it", "tyre"), &plane = drawn.one("joints/it", "plane");
  CHECK(number_of(tyre, "radius") == 0.3);
  CHECK(drawn.at(tyre).x.isApprox(Vector3(1, 2, 0.3), 1e-14));
  CHECK(drawn.at(tyre).R.col(2).isApprox(Vector3(0, 1, 0), 1e-14));
  CHECK(drawn.at(plane).R.col(2).isApprox(Vector3(0, 0, 1), 1e-14));
  CHECK(drawn.at(plane).x.z() == Approx(0).margin(1e-14));
}

TEST_CASE("a cam is drawn by its contour about the camshaft, with its roller") {
  const TemporaryFolder folder;
  std::string table;
  constexpr double e = 0.01, radius = 0.05;  // an eccentric disc, about a point at the distance e of its middle
  const auto contour = [](double angle) {
    return e * std::cos(angle) + std::sqrt(radius * radius - std::pow(e * std::sin(angle), 2));
  };
  for (int k = 0; k < 72; ++k) table += fmt::format("{}, {}\n", 2 * pi * k / 72, contour(2 * pi * k / 72));
  folder.file("cam.csv", table);
  for (const bool flat : {true, false}) {
    CAPTURE(flat);
    const DrawnModel drawn(wheels("[0, 0, 0]", "[0, 0, 0.08]") +
                               "  guide: {type: prismatic, nodes: [ground, b], axis: [0, 0, 1]}\n" +
                               "  it: {type: cam, joints: [pin_a, guide], profile: cam.csv, follower: " +
                               (flat ? "flat, normal: [0, 0, 1]}\n" : "roller, radius: 0.02}\n"),
                           folder / "model.yaml");
    const DrawnItem& cam = drawn.one("joints/it", "cam");
    CHECK(drawn.at(cam).x.isApprox(Vector3::Zero(), 1e-14));
    CHECK(drawn.at(cam).R.col(2).isApprox(Vector3(0, 1, 0), 1e-13));
    const auto& points = value_of<std::vector<std::vector<double>>>(cam, "contour");
    CHECK(points.size() >= 72);
    for (const auto& point : points)
      CHECK(std::hypot(point[0], point[1]) == Approx(contour(std::atan2(point[1], point[0]))).epsilon(1e-6));
    CHECK_FALSE(drawn.has("joints/it", "curve"));
    REQUIRE(drawn.has("joints/it", "pulley") == !flat);
    if (flat) continue;
    const DrawnItem& roller = drawn.one("joints/it", "pulley");
    CHECK(number_of(roller, "radius") == 0.02);
    CHECK(drawn.at(roller).x.isApprox(Vector3(0, 0, 0.08), 1e-14));
    CHECK(drawn.at(roller).R.col(2).isApprox(Vector3(0, 1, 0), 1e-13));
  }
}

/// Returns the length of the straight parts of a course between two places, tangent to both pulleys: a course that runs
/// along u touches a pulley of side +1 at u x z.
double length_of_course(const DrawnModel& drawn, const DrawnItem& course) {
  const std::size_t count = course.places.size();
  const bool closed = value_of<bool>(course, "closed");
  double length = 0;
  std::vector<Vector3> along(count);
  const std::size_t spans = closed ? count : count - 1;
  const Vector3 z = drawn.at(course.places[0]).R.col(2);
  const auto signed_radius = [&](std::size_t k) { return course.pulleys[k].side * course.pulleys[k].radius; };
  for (std::size_t k = 0; k < spans; ++k) {
    const std::size_t next = (k + 1) % count;
    const Vector3 d = drawn.at(course.places[next]).x - drawn.at(course.places[k]).x;
    const double change = signed_radius(next) - signed_radius(k);
    const double span = std::sqrt(d.squaredNorm() - change * change);
    length += span;
    // With the points p + r (u x z) of the two pulleys, d = span u - change (u x z).
    const Vector3 x = d.normalized(), y = z.cross(x);
    const double sine = -change / d.norm();
    along[k] = span / d.norm() * x + sine * y;
  }
  for (std::size_t k = closed ? 0 : 1; k < spans; ++k) {  // arcs, of less than one turn
    const Vector3 &from = along[(k + count - 1) % count], &to = along[k];
    double angle = course.pulleys[k].side * std::atan2(from.cross(to).dot(z), from.dot(to));
    if (angle < -1e-9) angle += 2 * pi;
    length += angle * course.pulleys[k].radius;
  }
  return length;
}

TEST_CASE("the course of a belt has its length: open and crossed") {
  const double r = 0.1, R = 0.2, d = 0.5;
  for (const bool crossed : {false, true}) {
    CAPTURE(crossed);
    const DrawnModel drawn(wheels("[0, 0, 0]", "[0.5, 0, 0]") + "  it: {type: belt, nodes: [a, b], radii: [0.1, " +
                           (crossed ? "-0.2" : "0.2") + "], axis: [0, 1, 0], EA: 1e4}\n");
    const double sine = ((crossed ? R + r : R - r) / d), span = std::sqrt(d * d * (1 - sine * sine));
    const double arcs = crossed ? (pi + 2 * std::asin(sine)) * (r + R)
                                : (pi - 2 * std::asin(sine)) * r + (pi + 2 * std::asin(sine)) * R;
    const DrawnItem& course = drawn.one("joints/it", "course");
    CHECK(length_of_course(drawn, course) == Approx(2 * span + arcs).epsilon(1e-12));
    CHECK(drawn.all("joints/it", "pulley").size() == 2);
  }
}

TEST_CASE("a cable runs over its pulley from point to point") {
  const DrawnModel drawn(
      "nodes: {p: {position: [0, 0, 0]}, w: {position: [0.1, 0, -1], fixed: [rx, ry, rz]}}\n"
      "elements: {p: {type: rigid_body, node: p, mass: 1, inertia: [1, 1, 1]}, w: {type: point_mass, node: w, mass: "
      "1}}\n"
      "joints:\n"
      "  pin: {type: hinge, nodes: [ground, p], axis: [0, 1, 0]}\n"
      "  it: {type: cable, nodes: [ground, p, w], at: [[-0.1, 0, -2], ~, ~], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: "
      "1e5}\n");
  const DrawnItem& course = drawn.one("joints/it", "course");
  CHECK_FALSE(value_of<bool>(course, "closed"));
  CHECK(course.pulleys[0].radius == 0);
  // the rope rises by 2 m, turns half round the pulley over its top, and goes down by 1 m
  CHECK(length_of_course(drawn, course) == Approx(2 + 0.1 * pi + 1).epsilon(1e-12));
  CHECK(drawn.all("joints/it", "pulley").size() == 1);
}

}  // namespace test_drawn_wheels
