#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/reduction/free_body.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

/// A slender steel beam along x, 1 m x 20 mm x 20 mm.
const test::Box beam{{1, 0.02, 0.02}, {30, 1, 1}};

}  // namespace

TEST_CASE("The virial of a spinning body is that of its centrifugal load") {
  MassProperties body;
  body.mass = 2;
  body.inertia = Eigen::Vector3d(3, 4, 5).asDiagonal();  // int rho r r^T = diag(3, 2, 1)
  const std::vector<Eigen::Matrix3d> q = virials({}, body);
  REQUIRE(q.size() == 6);
  CHECK((q[2] - Eigen::Matrix3d(Eigen::Vector3d(3, 2, 0).asDiagonal())).norm() < 1e-14);  // Om_3^2: a = -(x, y, 0)
  CHECK((q[0] - Eigen::Matrix3d(Eigen::Vector3d(0, 2, 1).asDiagonal())).norm() < 1e-14);
  // Om_1 Om_2 of the free body: no net moment, so the antisymmetric part vanishes.
  CHECK((q[5] - q[5].transpose()).norm() < 1e-14);
}

TEST_CASE("A pull that accelerates a beam stiffens it as the tension that falls off along it") {
  // Unit force along x on end b of a free beam: N(x) = x / L. The shape u_z of a unit displacement of b is Hermite's
  // 3 s^2 - 2 s^3: int N u'^2 dx = 36/L int s (s - s^2)^2 ds = 0.6 / L; of a, N is the same and u'^2 too: 0.6 / L.
  const Mesh mesh = test::box_mesh(beam);
  const Superelement body = test::reduced(mesh, test::steel_body(Tie::average, Tie::average));
  const Eigen::MatrixXd& k = body.load_stiffness[6];
  // Shear and the finite width change the shape by (h / L)^2 = 4e-4, the mesh by less.
  CHECK(k(8, 8) == Approx(0.6).epsilon(3e-3));
  CHECK(k(7, 7) == Approx(0.6).epsilon(3e-3));
  CHECK(k(2, 2) == Approx(0.6).epsilon(3e-3));
  CHECK(k(2, 8) == Approx(-0.6).epsilon(3e-3));
  // On end a the same push compresses: N(x) = -(1 - x / L).
  CHECK(body.load_stiffness[0](8, 8) == Approx(-0.6).epsilon(3e-3));
  // Slope at b (ry turns z down): u = -(s^3 - s^2) L, int N u'^2 = L int s (3 s^2 - 2 s)^2 ds = L (9/6 - 12/5 + 1).
  CHECK(k(10, 10) == Approx(0.1).epsilon(3e-3));
}

TEST_CASE("A beam that spins about a transverse axis is stretched by N = rho A (L^2/4 - r^2)/2") {
  // The same Hermite shape of end b: int N u'^2 dx, N = rho A L^2 (s - s^2) / 2: 18 rho A L int (s - s^2)^3 ds =
  // 18/140.
  const Mesh mesh = test::box_mesh(beam);
  const Superelement body = test::reduced(mesh, test::steel_body(Tie::average, Tie::average));
  const double expected = 18.0 / 140 * body.total_mass;
  CHECK(body.spin_stiffness[2](8, 8) == Approx(expected).epsilon(3e-3));  // about z, bending along z
  CHECK(body.spin_stiffness[2](7, 7) == Approx(expected).epsilon(3e-3));
  CHECK(body.spin_stiffness[1](7, 7) == Approx(expected).epsilon(3e-3));
  CHECK(std::abs(body.spin_stiffness[0](7, 7)) < 1e-2 * expected);  // about its own axis: nearly nothing
}

TEST_CASE("A slack arm between surface and interface node counts as the pendulum that it is") {
  // Interface b on an arm of 0.5 m beyond the end of the beam, pulled along x: turning the interface by theta while its
  // node stays in place moves the end of the arm; compare with the same body described at the surface itself, where
  // d_surface = d + (exp(theta) - I) (-arm): the energies must agree to second order in d and theta.
  const Mesh mesh = test::box_mesh(beam);
  const Tie tie = GENERATE(Tie::rigid, Tie::average);
  ReductionOptions options = test::steel_body(Tie::average, tie);
  const Superelement at_surface = test::reduced(mesh, options);
  const Eigen::Vector3d arm(0.5, 0, 0);
  options.interfaces[1].position = at_surface.interfaces[1].position + arm;
  const Superelement at_arm = test::reduced(mesh, options);
  // A force F along x, in line with the arm, has the same stress in both. With d_surface of second order
  // -theta x (theta x arm) / 2 the force F works: H = F.arm I - sym(F arm^T) for the arm's rotations.
  Eigen::MatrixXd transform = Eigen::MatrixXd::Identity(12, 12);
  transform.block<3, 3>(6, 9) = skew(arm);
  Eigen::MatrixXd expected = transform.transpose() * at_surface.load_stiffness[6] * transform;
  expected.bottomRightCorner<3, 3>() += Eigen::Vector3d(0, 0.5, 0.5).asDiagonal();
  CHECK((at_arm.load_stiffness[6] - expected).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("The elastic energy to third order does not depend on the frame, whatever the interfaces hold and how") {
  const Tie tie = GENERATE(Tie::rigid, Tie::average);
  const std::array<bool, 3> turns = GENERATE(std::array{true, true, true}, std::array{true, false, true},
                                             std::array{false, true, false}, std::array{false, false, false});
  ReductionOptions options = test::steel_body(tie, tie, 3);
  std::copy(turns.begin(), turns.end(), options.interfaces[1].kept.begin() + 3);
  options.interfaces[1].rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  options.interfaces[1].position = Eigen::Vector3d(0.45, 0.06, 0.1);
  Superelement body = test::reduced(test::twisted_block(), options);
  const auto objectivity = [&] {
    for (const Check& check : check_superelement(body)) {
      if (check.name == "load_stiffness_objectivity") {
        return check.value;
      }
    }
    return -1.0;
  };
  CHECK(objectivity() >= 0);
  CHECK(objectivity() < 1e-10);  // the factorisation's rounding
  // An error of a tenth of one matrix must be detected.
  body.load_stiffness[7] *= 1.1;
  CHECK(objectivity() > 1e-4);
}
