// Tests of the inertia of large rotations that is computed from matrices of other programs.
#include <catch2/catch.hpp>

#include "reduce/matrices/rigid_split.hpp"
#include "reduce/reduction/checks.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/unit/reduce/matrices/matrix_bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

/// Returns S_kl U with the rigid motions U about the centre: the first moments in momentum and centrifugal forces.
Eigen::MatrixXd moments(const Superelement& body, std::size_t component) {
  return body.inertia_components[component] * rigid_coordinates(body, body.centre);
}

/// Returns the kinetic energy of a rigid spin about an axis divided by the squared rate, from the inertia components
/// alone.
double spin_energy(const Superelement& body, const Eigen::Vector3d& axis) {
  Eigen::VectorXd turn = rigid_coordinates(body, body.centre).rightCols(3) * axis;
  return 0.5 * turn.dot((body.inertia_components[0] + body.inertia_components[1] + body.inertia_components[2]) * turn);
}

}  // namespace

TEST_CASE("The blocks of the nodes give the inertia of a beam in all directions") {
  // The mass of lateral motion is at the nodes, up to terms of the order of the element length.
  const int elements = GENERATE(1, 10);
  const Superelement body = test::reduced(test::beam_set(elements), {});
  const Eigen::MatrixXd rigid = rigid_coordinates(body, body.centre);
  const double most = elements == 1 ? 0.05 : 0.005;
  for (int k = 0; k < 3; ++k) CHECK(spin_energy(body, Eigen::Vector3d::Unit(k)) == Approx(body.inertia(k, k) / 2));
  CHECK((rigid.col(1).transpose() * body.inertia_components[1] * rigid.col(1)).value() == Approx(6));
  CHECK(std::abs((rigid.col(1).transpose() * body.inertia_components[0] * rigid.col(1)).value()) < 1e-9);
  // A spin about z is motion along y: S_22 contains m L^2 / 12 = 2; S_22 and S_33 share the torsional inertia.
  CHECK((rigid.col(5).transpose() * body.inertia_components[1] * rigid.col(5)).value() == Approx(2.0).epsilon(0.01));
  CHECK(body.checks.at("unknown_inertia_share") < most);
}

TEST_CASE("Points with masses and inertia give the inertia components exactly") {
  NodalShapes points;
  points.points = Eigen::Matrix3Xd::Random(3, 7);
  points.masses = Eigen::VectorXd::LinSpaced(7, 1, 2);
  Eigen::Matrix3d J = Eigen::Vector3d(2, 3, 4).asDiagonal();
  points.inertias.assign(7, J);
  const Eigen::MatrixXd u = rigid_motions(points.points, Eigen::Vector3d::Zero());
  Eigen::MatrixXd turns = Eigen::MatrixXd::Zero(21, 6);
  for (int a = 0; a < 7; ++a) turns.block<3, 3>(3 * a, 3).setIdentity();
  const auto S = inertia_of_points(points, u, turns);
  const Eigen::MatrixXd sum = S[0] + S[1] + S[2];
  Eigen::Matrix3d expected = 7 * J;
  for (int a = 0; a < 7; ++a) expected -= points.masses(a) * skew(points.points.col(a)) * skew(points.points.col(a));
  CHECK((sum.bottomRightCorner(3, 3) - expected).norm() < 1e-12);
}

TEST_CASE("The rigid part and the stretching of a beam are exact from reduced matrices with scalars") {
  MatrixSet set = test::beam_set(2);
  for (int k = 0; k < 6; ++k) set.unknowns[static_cast<std::size_t>(6 + k)] = {-1, k};
  const Superelement body = test::reduced(set, {});
  for (int k = 0; k < 3; ++k) CHECK(spin_energy(body, Eigen::Vector3d::Unit(k)) == Approx(body.inertia(k, k) / 2));
  // The row of M~ that belongs to the translation along k gives the momentum along k of any motion.
  const Eigen::MatrixXd rigid = rigid_coordinates(body, body.centre);
  CHECK((moments(body, 0).col(0) - body.mass * rigid.col(0)).norm() < 1e-9);
  CHECK((moments(body, 1).col(1) - body.mass * rigid.col(1)).norm() < 1e-9);
  // The beam is stretched by 1 at the right end, u_x = x / L. The first moment in a spin about y or z is the integral
  // of rho (x - L/2) u_x = rho L^2 / 12 = 1.
  CHECK(std::abs(moments(body, 5)(6, 5)) == Approx(1).epsilon(0.01));
  CHECK(std::abs(moments(body, 4)(6, 4)) == Approx(1).epsilon(0.01));
  CHECK(body.checks.at("unknown_inertia_share") > 0.1);  // the inertia of bending is reported as unknown
}

TEST_CASE("Equal masses at the points of shapes give the directions of inertia on a regular mesh") {
  // The cells of the bar are equal, and so are the masses of its points except on the surface.
  const Mesh mesh = test::box_mesh({{0.4, 0.1, 0.15}, {12, 3, 4}});
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 4);
  const Superelement exact = test::reduced(mesh, options);
  MatrixSet set;
  set.name = "bar";
  set.source = "test";
  set.positions.resize(3, 2);
  for (int a = 0; a < 2; ++a) {
    const Interface& interface = exact.interfaces[static_cast<std::size_t>(a)];
    set.positions.col(a) = interface.position;
    set.axes.push_back(interface.rotation);
    set.numbers.push_back(a + 1);
    for (int c = 0; c < 6; ++c) set.unknowns.push_back({a, c});
  }
  for (int k = 0; k < 4; ++k) set.unknowns.push_back({-1, k});
  set.stiffness = test::sparse(exact.stiffness);
  set.mass = test::sparse(exact.mass);
  const Superelement alone = test::reduced(set, {});
  set.shapes.emplace();
  set.shapes->points = mesh.points;
  set.shapes->displacement = exact.displacement_recovery;
  const Superelement shaped = test::reduced(set, {});
  const auto error = [&](const Superelement& body) {
    double worst = 0;
    for (std::size_t k = 0; k < 6; ++k)
      worst = std::max(worst, (body.inertia_components[k] - exact.inertia_components[k]).norm() / exact.mass.norm());
    return worst;
  };
  CHECK(error(shaped) < 0.05);
  CHECK(error(alone) > error(shaped));
  CHECK(alone.checks.at("unknown_inertia_share") > 0.1);
}

TEST_CASE("The components add up to M~, independently of their source") {
  MatrixSet set = test::beam_set(3);
  MatrixOptions options;
  options.interfaces = {test::tied("a", {10}), test::tied("b", {40})};
  const Superelement body = test::reduced(set, options);
  const Eigen::MatrixXd sum = body.inertia_components[0] + body.inertia_components[1] + body.inertia_components[2];
  CHECK((sum - body.mass).norm() < 1e-12 * body.mass.norm());
}

TEST_CASE("The rest of the energy is shared by three directions if they are unknown, and scaled if they are known") {
  // The coordinates are six rigid motions and two deformations, with a unit mass matrix. The components contain 0.3 of
  // the energy of the first deformation, all along x, and 0.8 of that of the second, all along y.
  MassProperties properties;
  properties.mass = 1;
  properties.inertia = Eigen::Matrix3d::Identity();
  const Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(8, 8);
  const RigidSplit split = split_rigid(mass, properties, mass.leftCols(6));
  std::array<Eigen::MatrixXd, 6> told;
  told.fill(Eigen::MatrixXd::Zero(8, 8));
  told[0](6, 6) = 0.3;
  told[1](7, 7) = 0.8;
  const RestInertia rest = rest_inertia(told, mass, split);
  Eigen::MatrixXd open = Eigen::MatrixXd::Zero(8, 8);
  open(6, 6) = 0.7;
  CHECK((rest.open - open).norm() < 1e-12);
  std::array<Eigen::MatrixXd, 3> expected;
  for (std::size_t k = 0; k < 3; ++k) expected[k] = open / 3 + told[k];
  expected[1](7, 7) = 1;
  for (std::size_t k = 0; k < 3; ++k) CHECK((rest.components[k] - expected[k]).norm() < 1e-12);
}
