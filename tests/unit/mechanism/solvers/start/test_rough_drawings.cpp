// Loops that are drawn 5 % and 20 degrees off: a four-bar, a delta robot, a Stewart platform.
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/four_bar.hpp"
#include "tests/support/rough_drawing.hpp"

using namespace bielle::mechanism;
using bielle::test::FourBar;
using bielle::test::list;
using bielle::test::RoughDrawing;

namespace {

constexpr double turn_off = 20 * M_PI / 180;

/// Returns the axes of a link from p to q: x along it, z as close to the given one as possible.
Matrix3 link_axes(const Vector3& p, const Vector3& q, const Vector3& z = Vector3::UnitZ()) {
  const Vector3 x = (q - p).normalized(), y = z.cross(x).normalized();
  Matrix3 R;
  R << x, y, x.cross(y);
  return R;
}

/// Returns links of 0.3, 0.9 and 0.7 m between posts 1 m apart; nodes in their middle.
std::string four_bar(unsigned seed, const FourBar& fits, const std::string& crank_keys = "",
                     const std::string& rocker_keys = "", double coupler = 0.9) {
  RoughDrawing drawing(seed, 0.05, turn_off);
  drawing.add_body("crank", 0.5 * (fits.A + fits.B), link_axes(fits.A, fits.B));
  drawing.add_body("coupler", 0.5 * (fits.B + fits.C), link_axes(fits.B, fits.C));
  drawing.add_body("rocker", 0.5 * (fits.D + fits.C), link_axes(fits.D, fits.C));
  const std::string axes = "axis: [[0, 0, 1], [0, 0, 1]], second_axis: [[1, 0, 0], [1, 0, 0]]";
  const auto hinge = [&](const std::string& name, const std::string& nodes, const std::string& at,
                         const std::string& keys) {
    return fmt::format("  {}: {{type: hinge, nodes: [{}], at: [{}], {}{}}}\n", name, nodes, at, axes, keys);
  };
  return drawing.text(hinge("a", "ground, crank", "[0, 0, 0], [-0.15, 0, 0]", crank_keys) +
                      hinge("b", "crank, coupler", fmt::format("[0.15, 0, 0], [{:.17g}, 0, 0]", -coupler / 2), "") +
                      hinge("c", "coupler, rocker", fmt::format("[{:.17g}, 0, 0], [0.35, 0, 0]", coupler / 2), "") +
                      hinge("d", "ground, rocker", "[1, 0, 0], [-0.35, 0, 0]", rocker_keys));
}

/// Returns the other way to close it: C mirrored on the line from B to D.
FourBar crossed(FourBar bar) {
  const Vector3 e = (bar.D - bar.B).normalized(), r = bar.C - bar.B;
  bar.C = bar.B + 2 * e.dot(r) * e - r;
  return bar;
}

double direction(const Vector3& from, const Vector3& to) { return std::atan2(to.y() - from.y(), to.x() - from.x()); }

void check_four_bar(Session& session, const FourBar& fits, double tolerance = 1e-10) {
  CHECK((session.node("crank").x - 0.5 * (fits.A + fits.B)).norm() < tolerance);
  CHECK((session.node("coupler").x - 0.5 * (fits.B + fits.C)).norm() < tolerance);
  CHECK((session.node("rocker").x - 0.5 * (fits.D + fits.C)).norm() < tolerance);
  CHECK((session.node("coupler").R - link_axes(fits.B, fits.C)).norm() < tolerance);
}

}  // namespace

TEST_CASE("a four-bar drawn 5 % and 20 degrees off closes in its plane, with its crank where the file says") {
  const FourBar fits = bielle::test::released_four_bar();
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Session session(read_mechanism_text(four_bar(seed, fits, ", start: 1.0471975511965976"), "bar.yaml").model);
    CHECK(session.redundant().size() == 1);  // z, rx, ry of the last hinge, found where it closes
    CHECK(session.mobility().degrees == 1);
    const StartReport report = session.assemble();
    check_four_bar(session, fits);
    CHECK(report.moved_nodes.size() == 3);
    CHECK(report.moved_coordinates.size() == 4);
  }
}

TEST_CASE("without start values a loop closes next to its drawing") {
  const FourBar fits = bielle::test::released_four_bar();
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Session session(read_mechanism_text(four_bar(seed, fits), "bar.yaml").model);
    const State drawn = session.state();
    session.assemble();
    // It fits somewhere within 0.05 m and 20 degrees: the nearest place may be farther only because of the metric.
    for (std::size_t k = 1; k < drawn.nodes.size(); ++k) {
      CHECK((session.state().nodes[k].x - drawn.nodes[k].x).norm() < 0.2);
      CHECK(log_so3(Matrix3(session.state().nodes[k].R.transpose() * drawn.nodes[k].R)).norm() < 3 * turn_off);
    }
    const NodeState &crank = session.node("crank"), &coupler = session.node("coupler"),
                    &rocker = session.node("rocker");
    const auto point = [](const NodeState& node, double x) { return Vector3(node.x + node.R * Vector3(x, 0, 0)); };
    CHECK(point(crank, -0.15).norm() < 1e-11);
    CHECK((point(crank, 0.15) - point(coupler, -0.45)).norm() < 1e-11);
    CHECK((point(coupler, 0.45) - point(rocker, 0.35)).norm() < 1e-11);
    CHECK((point(rocker, -0.35) - Vector3(1, 0, 0)).norm() < 1e-11);
    for (const NodeState* node : {&crank, &coupler, &rocker}) CHECK((node->R.col(2) - Vector3::UnitZ()).norm() < 1e-11);
  }
}

TEST_CASE("the start value of the rocker chooses the branch of a four-bar that is drawn between both") {
  const FourBar open = bielle::test::released_four_bar(), other = crossed(open);
  FourBar between = open;
  between.C = 0.5 * (open.C + other.C);
  for (const FourBar& fits : {open, other}) {
    const double angle = direction(fits.D, fits.C);
    CAPTURE(angle);
    const std::string start = fmt::format(", start: {{angle: {:.17g}}}", angle);
    Session session(read_mechanism_text(four_bar(5, between, "", start), "bar.yaml").model);
    session.assemble();
    // The crank has two positions for this rocker; the one next to the drawing is expected.
    check_four_bar(session, fits, 1e-9);
    CHECK(std::abs(session.read("joints/d/coordinate")[0] - angle) < 1e-11);
  }
}

TEST_CASE("a delta robot drawn 5 % and 20 degrees off comes to the platform of its arms' angles") {
  // Base hinges on a circle of 0.2 m, arms of 0.25, rods of 0.6 in pairs 0.08 apart, platform joints on a circle of
  // 0.06.
  constexpr double base = 0.2, arm = 0.25, rod = 0.6, half = 0.04, platform = 0.06;
  const std::array<double, 3> angles = {0.3, -0.1, 0.45};  // angles of the arms below the horizontal
  std::array<Vector3, 3> radial, tangential, elbow, centre;
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = 2 * M_PI * static_cast<double>(k) / 3;
    radial[k] = Vector3(std::cos(a), std::sin(a), 0);
    tangential[k] = Vector3(-std::sin(a), std::cos(a), 0);
    elbow[k] = (base + arm * std::cos(angles[k])) * radial[k] - Vector3(0, 0, arm * std::sin(angles[k]));
    centre[k] = elbow[k] - platform * radial[k];  // the platform's middle lies on a sphere around it
  }
  // The lower of the two points at the rods' length from three centres.
  const Vector3 ex = (centre[1] - centre[0]).normalized();
  const double i = ex.dot(centre[2] - centre[0]), d = (centre[1] - centre[0]).norm();
  const Vector3 ey = (centre[2] - centre[0] - i * ex).normalized(), ez = ex.cross(ey);
  const double j = ey.dot(centre[2] - centre[0]), x = d / 2, y = (i * i + j * j) / (2 * j) - i * x / j,
               z = std::sqrt(rod * rod - x * x - y * y);
  Vector3 middle = centre[0] + x * ex + y * ey + z * ez;
  if (const Vector3 above = centre[0] + x * ex + y * ey - z * ez; above.z() < middle.z()) middle = above;
  REQUIRE(middle.z() < -0.3);

  for (unsigned seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    RoughDrawing drawing(seed, 0.05 * 0.8, turn_off);
    std::string joints;
    drawing.add_body("platform", middle, Matrix3::Identity());
    for (std::size_t k = 0; k < 3; ++k) {
      Matrix3 R;  // x along the arm, y along its hinge
      const Vector3 along = (elbow[k] - base * radial[k]).normalized();
      R << along, tangential[k], along.cross(tangential[k]);
      const std::string name = fmt::format("arm_{}", k);
      drawing.add_body(name, base * radial[k], R);
      joints += fmt::format(
          "  base_{}: {{type: hinge, nodes: [ground, {}], at: [{}, [0, 0, 0]], axis: [{}, [0, 1, 0]], second_axis: "
          "[{}, [1, "
          "0, 0]], start: {:.17g}}}\n",
          k, name, list(base * radial[k]), list(tangential[k]), list(radial[k]), angles[k]);
      for (const int side : {-1, 1}) {
        const Vector3 from = elbow[k] + side * half * tangential[k],
                      to = middle + platform * radial[k] + side * half * tangential[k];
        const std::string link = fmt::format("rod_{}{}", k, side < 0 ? "a" : "b");
        drawing.add_body(link, 0.5 * (from + to), link_axes(from, to, tangential[k]));
        joints += fmt::format("  top_{}: {{type: spherical, nodes: [{}, {}], at: [[{}, {}, 0], [{}, 0, 0]]}}\n", link,
                              name, link, arm, side * half, -rod / 2);
        joints += fmt::format("  low_{}: {{type: spherical, nodes: [{}, platform], at: [[{}, 0, 0], {}]}}\n", link,
                              link, rod / 2, list(platform * radial[k] + side * half * tangential[k]));
      }
    }
    Session session(read_mechanism_text(drawing.text(joints), "delta.yaml").model);
    session.assemble();
    CHECK((session.node("platform").x - middle).norm() < 1e-10);
    CHECK((session.node("platform").R - Matrix3::Identity()).norm() < 1e-10);
  }
}

TEST_CASE("a Stewart platform drawn 5 % and 20 degrees off comes to the pose of its legs' lengths") {
  Frame pose;
  pose.x = Vector3(0.05, -0.08, 0.9);
  pose.R = exp_so3(Vector3(0.1, -0.15, 0.2));
  for (unsigned seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    RoughDrawing drawing(seed, 0.05, turn_off);
    drawing.add_body("platform", pose.x, pose.R);
    std::string joints;
    for (int k = 0; k < 6; ++k) {
      const double pair = 2 * M_PI / 3 * (k / 2), sign = k % 2 == 0 ? -1 : 1;
      const double below = pair + sign * 0.25, above = pair + sign * (M_PI / 3 - 0.2);
      const Vector3 foot(0.6 * std::cos(below), 0.6 * std::sin(below), 0),
          head(0.35 * std::cos(above), 0.35 * std::sin(above), 0), top = pose.x + pose.R * head;
      const Matrix3 R = link_axes(foot, top);  // x along the leg
      const double length = (top - foot).norm();
      drawing.add_body(fmt::format("cylinder_{}", k), foot, R);
      drawing.add_body(fmt::format("piston_{}", k), top, R);
      joints += fmt::format("  foot_{}: {{type: spherical, nodes: [ground, cylinder_{}], at: [{}, [0, 0, 0]]}}\n", k, k,
                            list(foot));
      joints += fmt::format("  head_{}: {{type: spherical, nodes: [piston_{}, platform], at: [[0, 0, 0], {}]}}\n", k, k,
                            list(head));
      joints += fmt::format(
          "  leg_{}: {{type: prismatic, nodes: [cylinder_{}, piston_{}], at: [[0, 0, 0], [0, 0, 0]], axis: [[1, 0, 0], "
          "[1, "
          "0, 0]], second_axis: [[0, 1, 0], [0, 1, 0]], start: {:.17g}}}\n",
          k, k, k, length);
    }
    Session session(read_mechanism_text(drawing.text(joints), "stewart.yaml").model);
    session.assemble();
    CHECK((session.node("platform").x - pose.x).norm() < 1e-10);
    CHECK((session.node("platform").R - pose.R).norm() < 1e-10);
  }
}

TEST_CASE("a slider-crank drawn with its links in line leaves that position for its start value") {
  const std::string text = R"yaml(
nodes: {c: {position: [0.5, 0, 0]}, k: {position: [1.5, 0, 0]}, p: {position: [2, 0, 0]}}
elements:
  c: {type: rigid_body, node: c, mass: 1, inertia: [0.1, 0.1, 0.1]}
  k: {type: rigid_body, node: k, mass: 1, inertia: [0.1, 0.1, 0.1]}
  p: {type: rigid_body, node: p, mass: 1, inertia: [0.1, 0.1, 0.1]}
joints:
  h1: {type: hinge, nodes: [ground, c], axis: [0, 1, 0], position: [0, 0, 0]}
  h2: {type: hinge, nodes: [c, k], axis: [0, 1, 0], position: [1, 0, 0]}
  h3: {type: spherical, nodes: [k, p], position: [2, 0, 0]}
  s: {type: prismatic, nodes: [ground, p], position: [2, 0, 0], axis: [1, 0, 0], start: -0.2}
)yaml";
  Session session(read_mechanism_text(text, "line.yaml").model);
  CHECK(session.mobility().degrees == 1);
  session.assemble();
  // Two links of 1 m over 1.8 m.
  CHECK(session.node("p").x.x() == Approx(1.8).epsilon(1e-12));
  CHECK(session.node("c").x.x() == Approx(0.45).epsilon(1e-10));
  CHECK(std::abs(session.node("c").x.z()) == Approx(0.5 * std::sqrt(1 - 0.81)).epsilon(1e-10));
}

TEST_CASE("a beam in a loop that is drawn roughly comes to its place free of stress") {
  // Fixed post, crank and slider; the rod between them is a beam of the right length, drawn 0.04 m and 15 degrees away.
  const double length = std::sqrt(0.9 * 0.9 + 0.3 * 0.3), off = 15 * M_PI / 180;
  const Vector3 begin(0.03, 0.32, 0.02), end = begin + length * Vector3(std::cos(off), -std::sin(off), 0);
  Session session(read_mechanism_text(fmt::format(R"yaml(
nodes:
  crank: {{position: [0, 0, 0], rotation_vector: [0.1, 0.1, 0.1]}}
  from: {{position: {}}}
  to: {{position: {}}}
  slider: {{position: [0.95, 0.05, 0.03], rotation_vector: [0.2, 0, -0.1]}}
elements:
  crank: {{type: rigid_body, node: crank, mass: 1, inertia: [0.1, 0.1, 0.1]}}
  slider: {{type: rigid_body, node: slider, mass: 1, inertia: [0.1, 0.1, 0.1]}}
  rod: {{type: beam, nodes: [from, to], elements: 4, section: {{circle: 0.01, young: 210e9, poisson: 0.3, density: 7850}}}}
joints:
  main: {{type: hinge, nodes: [ground, crank], at: [[0, 0, 0], [0, 0, 0]], axis: [[0, 0, 1], [0, 0, 1]],
         second_axis: [[0, 1, 0], [0, 1, 0]], start: 0}}
  pin: {{type: spherical, nodes: [crank, from], at: [[0, 0.3, 0], [0, 0, 0]]}}
  wrist: {{type: spherical, nodes: [to, slider], at: [[0, 0, 0], [0, 0, 0]]}}
  guide: {{type: prismatic, nodes: [ground, slider], at: [[0, 0, 0], [0, 0, 0]], axis: [[1, 0, 0], [1, 0, 0]],
          second_axis: [[0, 1, 0], [0, 1, 0]]}}
)yaml",
                                                  list(begin), list(end)),
                                      "rod.yaml")
                      .model);
  session.assemble();
  CHECK((session.node("crank").R - Matrix3::Identity()).norm() < 1e-10);
  CHECK((session.node("from").x - Vector3(0, 0.3, 0)).norm() < 1e-10);
  CHECK((session.node("slider").x - Vector3(0.9, 0, 0)).norm() < 1e-9);
  CHECK((session.node("slider").R - Matrix3::Identity()).norm() < 1e-10);
  // A stretch by 1e-7 of the length would store 3e-7 J.
  CHECK(session.energy().elastic < 1e-9);
}
