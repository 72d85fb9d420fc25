// Rigid bodies and point masses: closed forms, and the checks of their input. (Tangents, invariance and power:
// tests/laws.)
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/elements/rigid_body/solid_reader.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/matrix_error.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::error;
using bielle::test::model_from_text;
using bielle::test::Random;
using Catch::Contains;

namespace {

std::unique_ptr<Model> body(const std::string& keys) {
  return model_from_text(
      "nodes: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0]}, c: {position: [2, 0, 0]}}\n"
      "elements:\n  disk: {type: rigid_body, node: a, " +
      keys + "}\n");
}

/// Returns the mass matrix of a body about its node.
MatrixX mass_matrix(const Model& model) {
  const DenseModel dense(model);
  return dense.tangent(dense.start(), DenseModel::Part::M).block<6, 6>(6, 6);
}

}  // namespace

TEST_CASE("a rigid body is equivalent to the mass points that it is made of") {
  Random random(1);
  const Frame frame{random.vector3(), exp_so3(random.vector3(2))};
  const Vector3 v = random.vector3(), Omega = random.vector3(3), a = random.vector3(5), Omegadot = random.vector3(4),
                gravity = random.vector3(10);
  // Four mass points make any inertia; their forces are sums of m (acceleration - gravity).
  MassProperties p;
  Eigen::Matrix<double, 6, 1> force = Eigen::Matrix<double, 6, 1>::Zero();
  Vector3 momentum = Vector3::Zero(), angular = Vector3::Zero();
  double kinetic = 0, potential = 0;
  std::array<Vector3, 4> points;
  std::array<double, 4> masses{1, 2, 0.5, 3};
  for (std::size_t k = 0; k < 4; ++k) {
    points[k] = random.vector3();
    const Vector3 x = frame.x + frame.R * points[k];
    const Vector3 velocity = v + frame.R * Omega.cross(points[k]);
    const Vector3 f =
        masses[k] * (a - gravity + frame.R * (Omegadot.cross(points[k]) + Omega.cross(Omega.cross(points[k]))));
    force.head<3>() += f;
    force.tail<3>() += points[k].cross(frame.R.transpose() * f);
    momentum += masses[k] * velocity;
    angular += masses[k] * x.cross(velocity);
    kinetic += 0.5 * masses[k] * velocity.squaredNorm();
    potential -= masses[k] * gravity.dot(x);
    p.mass += masses[k];
    p.centre += masses[k] * points[k];
  }
  p.centre /= p.mass;
  for (std::size_t k = 0; k < 4; ++k) p.inertia -= masses[k] * skew(points[k] - p.centre) * skew(points[k] - p.centre);

  Model model;
  Node node;
  node.name = std::string("a");  // gcc 12 warns of plain assignment (its bug 105651)
  node.frame = frame;
  node.velocity = v;
  node.angular_velocity = Omega;
  model.environment.gravity = gravity;
  model.add(std::make_unique<RigidBody>("rigid_body", "four points", model.add_node(node), p),
            Entry{Section::elements, "four"});
  const DenseModel dense(model);
  State state = dense.start();
  state.nodes[1].a = a;
  state.nodes[1].Omegadot = Omegadot;
  CHECK(error(dense.residual(state).tail<6>(), force) < 1e-12);
  CHECK_THAT(dense.energy(state).kinetic, Catch::WithinAbs(kinetic, 1e-12));
  CHECK_THAT(dense.energy(state).gravity, Catch::WithinAbs(potential, 1e-12));
  Slots slots;
  slots.nodes = {1};
  Eigen::Matrix<double, 9, 1> out;
  model.members()[0].component->write_output({state, slots, model.environment}, out.data());
  CHECK(error(out.head<3>(), frame.x + frame.R * p.centre) < 1e-14);
  CHECK(error(out.segment<3>(3), momentum) < 1e-12);
  CHECK(error(out.tail<3>(), angular) < 1e-12);
}

TEST_CASE("inertia is given about the centre of mass as three, six or nine numbers") {
  MatrixX expected = MatrixX::Identity(6, 6) * 2;
  expected.bottomRightCorner<3, 3>() << 1, 0.1, -0.2, 0.1, 1.5, 0.3, -0.2, 0.3, 2;
  CHECK(error(mass_matrix(*body("mass: 2, inertia: [1, 1.5, 2, 0.1, -0.2, 0.3]")), expected) < 1e-15);
  CHECK(error(mass_matrix(*body("mass: 2, inertia: [[1, 0.1, -0.2], [0.1, 1.5, 0.3], [-0.2, 0.3, 2]]")), expected) <
        1e-15);
  expected.bottomRightCorner<3, 3>() = Vector3(1, 1.5, 2).asDiagonal();
  CHECK(error(mass_matrix(*body("mass: 2, inertia: [1, 1.5, 2]")), expected) < 1e-15);
  // By Steiner's theorem, the centre (0, 0, 3) adds 2 * 9 about x and y and couples force and moment.
  expected(3, 3) += 18;
  expected(4, 4) += 18;
  expected(0, 4) = expected(4, 0) = 6;
  expected(1, 3) = expected(3, 1) = -6;
  CHECK(error(mass_matrix(*body("mass: 2, inertia: [1, 1.5, 2], centre: [0, 0, 3]")), expected) < 1e-14);
}

TEST_CASE("inertia may be given about the node and in axes of its own") {
  // The same body is described in four ways: principal moments in axes turned by R, centre off the node.
  const Vector3 c(0.3, -0.2, 0.5);
  const Matrix3 R = exp_so3({0.4, 0.3, -0.8});
  MassProperties p{2, c, R * Vector3(1, 1.5, 2).asDiagonal() * R.transpose()};
  const auto entries = [](const Matrix3& J) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}, {:.17g}, {:.17g}, {:.17g}]", J(0, 0), J(1, 1), J(2, 2), J(0, 1),
                       J(0, 2), J(1, 2));
  };
  MatrixX expected = MatrixX::Identity(6, 6) * 2;
  expected.topRightCorner<3, 3>() = -2 * skew(c);
  expected.bottomLeftCorner<3, 3>() = 2 * skew(c);
  expected.bottomRightCorner<3, 3>() = p.inertia_about_origin();
  const std::string start = "mass: 2, centre: [0.3, -0.2, 0.5], ";
  const std::string axes = ", inertia_axes: {rotation_vector: [0.4, 0.3, -0.8]}";
  CHECK(error(mass_matrix(*body(start + "inertia: " + entries(p.inertia))), expected) < 1e-14);
  CHECK(error(mass_matrix(*body(start + "inertia: [1, 1.5, 2]" + axes)), expected) < 1e-14);
  CHECK(error(mass_matrix(*body(start + "inertia_about: node, inertia: " + entries(p.inertia_about_origin()))),
              expected) < 1e-14);
  CHECK(error(mass_matrix(*body(start + "inertia_about: node, inertia: " +
                                entries(R.transpose() * p.inertia_about_origin() * R) + axes)),
              expected) < 1e-14);
  CHECK_THROWS_WITH(body(start + "inertia: [1, 1, 1], inertia_about: origin"), Contains("inertia_about"));
  CHECK_THROWS_WITH(body(start + "inertia: [0.1, 0.1, 0.1], inertia_about: node"),
                    Contains("positive definite") && Contains("about the node?"));
  CHECK_THROWS_WITH(body(start + "inertia: [1, 1, 1], inertia_axes: {bryan: [1, 0, 0]}"), Contains("'bryant'"));
}

TEST_CASE("homogeneous solids have the inertia of textbooks") {
  const auto diagonal = [](const std::string& solid) {
    return VectorX(mass_matrix(*body("solid: {density: 3, " + solid + "}")).diagonal());
  };
  const double pi = 3.141592653589793;
  CHECK(error(diagonal("box: [1, 2, 4]"), (VectorX(6) << 24, 24, 24, 40, 34, 10).finished()) < 1e-13);
  CHECK(error(diagonal("sphere: 0.5") / (pi / 2), (VectorX(6) << 1, 1, 1, .1, .1, .1).finished()) < 1e-14);
  CHECK(error(diagonal("cylinder: [2, 6]") / (72 * pi), (VectorX(6) << 1, 1, 1, 4, 4, 2).finished()) < 1e-14);
  CHECK(error(diagonal("tube: [2, 1, 6]") / (54 * pi), (VectorX(6) << 1, 1, 1, 4.25, 4.25, 2.5).finished()) < 1e-14);
}

TEST_CASE("solids are placed and added up") {
  const auto matrix = [](const std::string& solid) { return mass_matrix(*body("solid: " + solid)); };
  // Two halves of a box are equal to the box.
  const MatrixX whole = matrix("{box: [2, 3, 5], density: 1.5}");
  CHECK(error(matrix("[{box: [1, 3, 5], density: 1.5, position: [0.5, 0, 0]}, "
                     "{box: [1, 3, 5], mass: 22.5, position: [-0.5, 0, 0]}]"),
              whole) < 1e-12);
  // The same box is drawn in other axes: its edges are exchanged by a quarter turn.
  CHECK(error(matrix("{box: [3, 2, 5], density: 1.5, rotation_vector: [0, 0, \"pi/2\"]}"), whole) < 1e-12);
  // A tube is a cylinder from which another is cut, in either order.
  const MatrixX tube = matrix("{tube: [2, 1, 6], density: 3, position: [1, 2, 3], euler: [0.2, 0.5, 1]}");
  const std::string outer = "{cylinder: [2, 6], density: 3, position: [1, 2, 3], euler: [0.2, 0.5, 1]}";
  const std::string inner = "{cylinder: [1, 6], density: 3, position: [1, 2, 3], euler: [0.2, 0.5, 1], cut: true}";
  CHECK(error(matrix("[" + outer + ", " + inner + "]"), tube) < 1e-10);
  CHECK(error(matrix("[" + inner + ", " + outer + "]"), tube) < 1e-10);
  // Steiner's theorem gives the inertia of a sphere off the node.
  const MassProperties ball = sphere(0.5);
  MatrixX expected = MatrixX::Identity(6, 6) * ball.mass;
  expected.topRightCorner<3, 3>() = -ball.mass * skew(Vector3(0, 2, 0));
  expected.bottomLeftCorner<3, 3>() = ball.mass * skew(Vector3(0, 2, 0));
  expected.bottomRightCorner<3, 3>() = Vector3(4.1, 0.1, 4.1).asDiagonal() * ball.mass;
  CHECK(error(matrix("{sphere: 0.5, density: 1, position: [0, 2, 0]}"), expected) < 1e-14);
}

TEST_CASE("cones and rings agree with sums of thin slices") {
  // A cone in slices: moments are polynomials of degree four in z, which Simpson's rule with Richardson would give
  // exactly; here the rest of the midpoint rule is extrapolated.
  const auto sliced = [](int n) {
    MassProperties sum;
    for (int k = 0; k < n; ++k) {
      const double s = (k + 0.5) / n, r = 2 + (0.5 - 2) * s;
      MassProperties disk = cylinder(r, 3.0 / n);
      disk.centre.z() = 3 * (s - 0.5);
      sum = k == 0 ? disk : sum + disk;
    }
    return sum;
  };
  const MassProperties coarse = sliced(100), fine = sliced(200), exact = cone(2, 0.5, 3);
  CHECK_THAT((4 * fine.mass - coarse.mass) / 3, Catch::WithinRel(exact.mass, 1e-8));
  CHECK_THAT((4 * fine.centre.z() - coarse.centre.z()) / 3, Catch::WithinRel(exact.centre.z(), 1e-7));
  CHECK(error((4 * fine.inertia - coarse.inertia) / 3, exact.inertia) < 1e-7 * exact.inertia.norm());
  // Special cases: cylinder; full cone m r^2 (3/10), (3/20) r^2 + (3/80) h^2 about its centre, h/4 above its base.
  CHECK(error(cone(2, 2, 3).inertia, cylinder(2, 3).inertia) < 1e-12);
  const MassProperties full = cone(2, 0, 4);
  CHECK_THAT(full.centre.z(), Catch::WithinRel(-1.0, 1e-14));
  CHECK(error(full.inertia / full.mass, MatrixX(Vector3(1.2, 1.2, 1.2).asDiagonal())) < 1e-14);
  CHECK(error(placed({Vector3::Zero(), exp_so3({M_PI, 0, 0})}, cone(0, 2, 4)).centre, full.centre) < 1e-14);
  // A ring of many balls: of the section's own inertia its volume elements keep (3/4, 5/8) r^2, so that a ring of
  // points is the limit of a thin one.
  const MassProperties thin = ring(2, 1e-4);
  CHECK(error(thin.inertia / thin.mass, MatrixX(Vector3(2, 2, 4).asDiagonal())) < 1e-8);
  CHECK_THAT(thin.mass, Catch::WithinRel(4 * M_PI * M_PI * 1e-8, 1e-14));
  // A thick ring: sums over its volume, in which the integral around the axis is exact.
  double mass = 0, polar = 0, across = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 64; ++j) {
      const double r = 0.7 * (i + 0.5) / n, t = 2 * M_PI * j / 64, rho = 2 + r * std::cos(t);
      const double volume = 2 * M_PI * rho * r * (0.7 / n) * (2 * M_PI / 64);
      mass += volume;
      polar += volume * rho * rho;
      across += volume * (rho * rho / 2 + std::pow(r * std::sin(t), 2));
    }
  CHECK_THAT(ring(2, 0.7).mass, Catch::WithinRel(mass, 1e-10));
  CHECK_THAT(ring(2, 0.7).inertia(2, 2), Catch::WithinRel(polar, 1e-6));
  CHECK_THAT(ring(2, 0.7).inertia(0, 0), Catch::WithinRel(across, 1e-6));
}

TEST_CASE("solids that make no body are refused") {
  const std::string ball = "{sphere: 1, density: 1}";
  CHECK_THROWS_WITH(body("solid: {sphere: 1, density: 1, cut: true}"), Contains("solid.cut"));
  CHECK_THROWS_WITH(body("solid: [" + ball + ", {sphere: 1, density: 2, cut: true}]"), Contains("leaves no mass"));
  CHECK_THROWS_WITH(body("solid: [" + ball + ", {sphere: 0.1, density: 2, cut: true}]"), Contains("has the density 2"));
  CHECK_THROWS_WITH(body("solid: [" + ball + ", {box: [0.1, 0.1, 0.1], density: 1, position: [30, 0, 0], cut: true}]"),
                    Contains("no body has this inertia") && Contains("inside of the other solids"));
  CHECK_THROWS_WITH(body("solid: []"), Contains("at least one solid"));
  CHECK_THROWS_WITH(body("solid: [" + ball + "], centre: [1, 0, 0]"), Contains("positions of their own"));
  CHECK_THROWS_WITH(body("solid: {sphere: 1, density: 1, mass: 2}"), Contains("either `density` or `mass`"));
  CHECK_THROWS_WITH(body("solid: {sphere: 1}"), Contains("density"));
  CHECK_THROWS_WITH(body("solid: {shpere: 1, density: 1}"),
                    Contains("'shpere' is not a key of a solid") && Contains("did you mean 'sphere'"));
  CHECK_THROWS_WITH(body("solid: {density: 1}"), Contains("exactly one of 'box', 'sphere'"));
  CHECK_THROWS_WITH(body("solid: {box: [1e200, 1e200, 1], density: 1}"),
                    Contains("elements.disk.solid.box") && Contains("too large or too small"));
  CHECK_THROWS_WITH(body("solid: {box: [1e-200, 1e-200, 1], density: 1}"), Contains("too large or too small"));
  CHECK_THROWS_WITH(body("solid: {box: [1e100, 1e100, 1], density: 1e200}"), Contains("too large or too small"));
  CHECK_THROWS_WITH(body("solid: {cone: [0, 0, 1], density: 1}"), Contains("radii"));
  CHECK_THROWS_WITH(body("solid: {ring: [1, 2], density: 1}"), Contains("must not exceed"));
  CHECK_THROWS_WITH(body("solid: {cylinder: [1], density: 1}"), Contains("[radius, length]"));
}

TEST_CASE("a point mass may stand off its node") {
  const auto model = model_from_text(
      "nodes: {a: {position: [0, 0, 0]}}\nelements: {bob: {type: point_mass, node: a, mass: 2, centre: [0, 0, 3]}}");
  MatrixX expected = MatrixX::Zero(6, 6);
  // No moment acts about the line through the node and the mass: any inertia there changes nothing.
  expected.diagonal() << 2, 2, 2, 18, 18, 1e-4 * 36;
  expected(0, 4) = expected(4, 0) = 6;
  expected(1, 3) = expected(3, 1) = -6;
  CHECK(error(mass_matrix(*model), expected) == 0);
}

TEST_CASE("a point mass has no rotary inertia") {
  const auto model =
      model_from_text("nodes: {a: {position: [0, 0, 0]}}\nelements: {bob: {type: point_mass, node: a, mass: 2}}");
  MatrixX expected = MatrixX::Zero(6, 6);
  expected.diagonal().head<3>().setConstant(2);
  CHECK(error(mass_matrix(*model), expected) == 0);
  CHECK(model->members()[0].component->type() == "point_mass");
}

TEST_CASE("a rigid body carries further nodes") {
  const auto model = body("mass: 1, inertia: [1, 1, 1], also: [b, c]");
  CHECK(model->node(2).carrier == 1);
  CHECK(model->node(3).carrier == 1);
  CHECK_THROWS_WITH(body("mass: 1, inertia: [1, 1, 1], also: [b, b]"),
                    Contains("model.yaml:3") && Contains("node 'b' is carried by node 'a' already"));
  CHECK_THROWS_WITH(body("mass: 1, inertia: [1, 1, 1], also: [a]"), Contains("'a' is the body's own node"));
  CHECK_THROWS_WITH(body("mass: 1, inertia: [1, 1, 1], also: [ground]"),
                    Contains("node 'ground' is fixed or moved, so 'disk' cannot carry it"));
}

TEST_CASE("a mass distribution that no body has is refused") {
  CHECK_THROWS_WITH(body("mass: 1, inertia: [1, 1, 3]"), Contains("elements.disk.inertia") &&
                                                             Contains("exceeds the sum of the two others") &&
                                                             Contains("1, 1 and 3"));
  CHECK_THROWS_WITH(body("mass: 1, inertia: [1, 1, -1]"), Contains("positive definite"));
  CHECK_THROWS_WITH(body("mass: 1, inertia: [1, 1, 1, 2, 0, 0]"), Contains("positive definite"));
  CHECK_THROWS_WITH(body("mass: 1, inertia: [1, 1]"), Contains("[xx, yy, zz, xy, xz, yz]"));
  CHECK_THROWS_WITH(body("mass: 1, inertia: [[1, 0, 0], [0.1, 1, 0], [0, 0, 1]]"), Contains("symmetric"));
  CHECK_THROWS_WITH(body("mass: 0, inertia: [1, 1, 1]"), Contains("elements.disk.mass"));
  CHECK_THROWS_WITH(body("mass: 1, solid: {sphere: 1, density: 1}"), Contains("either `solid` or `mass`"));
  CHECK_THROWS_WITH(body("solid: {sphere: 1, box: [1, 1, 1], density: 1}"), Contains("exactly one of"));
  CHECK_THROWS_WITH(body("solid: {tube: [1, 2, 3], density: 1}"), Contains("inner radius must be smaller"));
  CHECK_THROWS_WITH(body("mass: 1, inertia: [0, 0, 0]"), Contains("`point_mass`"));
  CHECK_THROWS_WITH(body("mass: 1, inertia: [0, 0, 1]"), Contains("exceeds the sum"));
  CHECK_THROWS_WITH(body("mass: 1e200, centre: [1e200, 0, 0], inertia: [1, 1, 1]"), Contains("too large"));
  // A line of mass has no inertia about itself, in any axes.
  CHECK_NOTHROW(body("mass: 1, inertia: [0, 1, 1]"));
  CHECK_NOTHROW(body("mass: 1, inertia: [0, 1, 1], inertia_axes: {bryant: [0.3, 0.7, -1.1]}"));
  CHECK_NOTHROW(body("mass: 1, inertia: [0.5, 0.5, 1, 0.5, 0, 0]"));
  // A thin disk lies on the bound, and its numbers are rounded by the user.
  CHECK_NOTHROW(body("mass: 1, inertia: [0.333, 0.333, 0.6662]"));
}

namespace {

/// Mass of a list of solids, and the warnings about them.
struct ReadSolids {
  double mass;
  std::string warnings;
  explicit ReadSolids(const std::string& list) {
    const bielle::YamlValue root = bielle::YamlValue::parse("solid: [" + list + "]", "m.yaml");
    mass = read_solids(root.at("solid")).mass;
    for (const std::string& warning : root.warnings()) warnings += warning + "\n";
  }
};

const std::string plate = "{box: [0.2, 0.2, 0.1], density: 1000}";

std::string hole(double radius, double length, const std::string& place) {
  return fmt::format("{{cylinder: [{}, {}], density: 1000, position: {}, cut: true}}", radius, length, place);
}

}  // namespace

TEST_CASE("a hole that is cut twice is refused") {
  const std::string once = hole(0.03, 0.1, "[0, 0, 0]");
  CHECK(ReadSolids(plate + ", " + once).mass == Approx(1000 * (0.004 - M_PI * 0.0009 * 0.1)));
  CHECK(ReadSolids(plate + ", " + once).warnings.empty());
  CHECK_THROWS_WITH(ReadSolids(plate + ", " + once + ", " + once),
                    Contains("solid[3]") && Contains("solid 2 of the list has cut it out already"));
  // This also holds if it is drawn elsewhere, or lies inside of the other.
  CHECK_THROWS_WITH(ReadSolids(plate + ", " + once + ", {tube: [0.03, 1e-6, 0.1], density: 1000, cut: true}"),
                    Contains("has cut it out already"));
  CHECK_THROWS_WITH(ReadSolids(plate + ", " + once + ", " + hole(0.01, 0.02, "[0.01, 0, 0.03]")),
                    Contains("has cut it out already"));
  CHECK_THROWS_WITH(ReadSolids(plate + ", " + hole(0.03, 0.1, "[0.15, 0, 0]")),
                    Contains("no other solid of its density is there"));
}

TEST_CASE("holes that overlap or project are told with their share") {
  // A counterbore is drawn through the hole below it.
  const ReadSolids bore(plate + ", " + hole(0.02, 0.1, "[0, 0, 0]") + ", " + hole(0.04, 0.05, "[0, 0, 0.025]"));
  CHECK_THAT(bore.warnings, Contains("solid[3]") && Contains("about 25 % of what this solid cuts out is not there") &&
                                Contains("solid 2 of the list has cut that part out already"));
  CHECK_THAT(ReadSolids(plate + ", " + hole(0.02, 0.2, "[0, 0, 0]")).warnings,
             Contains("about 50 % of what this solid cuts out is not there") &&
                 Contains("no other solid of its density is there"));
  // Two holes meet: one ends where the other begins.
  CHECK(ReadSolids(plate + ", " + hole(0.02, 0.05, "[0, 0, -0.025]") + ", " + hole(0.04, 0.05, "[0, 0, 0.025]"))
            .warnings.empty());
  // A solid that fills a hole can be cut again.
  const ReadSolids filled(plate + ", " + hole(0.03, 0.1, "[0, 0, 0]") + ", {cylinder: [0.02, 0.1], density: 1000}, " +
                          hole(0.01, 0.1, "[0, 0, 0]"));
  CHECK(filled.warnings.empty());
  CHECK(filled.mass == Approx(1000 * (0.004 - M_PI * 0.1 * (0.0009 - 0.0004 + 0.0001))));
}

TEST_CASE("the share of each shape that projects is that of its volume") {
  // Material above the plane z = 0 alone; of the cone (radii 0.1, in the middle 0.2, 0.3) 7 of 26
  // parts lie below, by a^2 + a b + b^2.
  const std::string material = "{box: [2, 2, 1], density: 1000, position: [0, 0, 0.5]}";
  for (const auto& [shape, share] : {std::pair{"box: [0.1, 0.2, 0.3]", "50"},
                                     {"sphere: 0.2", "50"},
                                     {"cylinder: [0.2, 0.3]", "50"},
                                     {"tube: [0.2, 0.19, 0.3]", "50"},
                                     {"cone: [0.1, 0.3, 0.4]", "27"},
                                     {"ring: [0.3, 0.1]", "50"}}) {
    CAPTURE(shape);
    CHECK_THAT(ReadSolids(material + ", {" + shape + ", density: 1000, cut: true}").warnings,
               Contains(fmt::format("about {} % of what", share)));
    CHECK(ReadSolids(material + ", {" + shape + ", density: 1000, position: [0, 0, 0.5], cut: true}").warnings.empty());
    // If it is turned over, the cone's other end projects.
    const std::string turned = ", density: 1000, rotation_vector: [3.141592653589793, 0, 0], cut: true}";
    CHECK_THAT(ReadSolids(material + ", {" + shape + turned).warnings,
               Contains(fmt::format("about {} % of what", share == std::string("27") ? "73" : share)));
  }
}

TEST_CASE("masses, lengths and inertias of bodies may have units, which must fit") {
  CHECK(error(mass_matrix(*body("mass: 2000 g, centre: [0, 0, 300 mm], inertia: [1, 1.5, 2e6 kg mm^2]")),
              mass_matrix(*body("mass: 2, centre: [0, 0, 0.3], inertia: [1, 1.5, 2]"))) < 1e-14);
  CHECK(error(mass_matrix(*body("mass: 2, inertia: [1, 1.5, 2], inertia_axes: {bryant: [90 deg, 0, 0]}")),
              mass_matrix(*body("mass: 2, inertia: [1, 2, 1.5]"))) < 1e-14);
  CHECK(error(mass_matrix(*body("solid: {tube: [20 cm, 100 mm, 0.3], density: 7.85 g/cm^3}")),
              mass_matrix(*body("solid: {tube: [0.2, 0.1, 0.3], density: 7850}"))) < 1e-12);
  CHECK_THROWS_WITH(body("mass: 2 m, inertia: [1, 1, 1]"),
                    Contains("elements.disk.mass: expected a value in kg, found one in 'm'"));
  CHECK_THROWS_WITH(body("solid: {sphere: 2 kg, density: 1}"),
                    Contains("elements.disk.solid.sphere: expected a value in m, found one in 'kg'"));
  CHECK_THROWS_WITH(model_from_text("nodes: {a: {}}\nelements: {p: {type: point_mass, node: a, mass: 1 s}}\n"),
                    Contains("elements.p.mass: expected a value in kg, found one in 's'"));
}
