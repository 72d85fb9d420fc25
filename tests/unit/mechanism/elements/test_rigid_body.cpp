// Rigid bodies and point masses: closed forms, and the checks of their input. (Tangents, invariance and power:
// tests/laws.)
#include <catch2/catch.hpp>

#include "mechanism/elements/rigid_body.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using bielle::test::Random;
using Catch::Contains;

namespace {

double error(const MatrixX& A, const MatrixX& B) { return (A - B).cwiseAbs().maxCoeff(); }

std::unique_ptr<Model> body(const std::string& keys) {
  return model_from_text(
      "nodes: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0]}, c: {position: [2, 0, 0]}}\n"
      "elements:\n  disk: {type: rigid_body, node: a, " +
      keys + "}\n");
}

/// The mass matrix of a body about its node.
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
  model.add(std::make_unique<RigidBody>("rigid_body", "four points", model.add_node(node), p), "elements/four");
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
  // Steiner: centre (0, 0, 3) adds 2 * 9 about x and y and couples force and moment.
  expected(3, 3) += 18;
  expected(4, 4) += 18;
  expected(0, 4) = expected(4, 0) = 6;
  expected(1, 3) = expected(3, 1) = -6;
  CHECK(error(mass_matrix(*body("mass: 2, inertia: [1, 1.5, 2], centre: [0, 0, 3]")), expected) < 1e-14);
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
  // A thin disk lies on the bound and is rounded by its user.
  CHECK_NOTHROW(body("mass: 1, inertia: [0.333, 0.333, 0.6662]"));
}
