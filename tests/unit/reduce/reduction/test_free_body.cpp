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

TEST_CASE("The virial of a spinning body equals that of its centrifugal load") {
  MassProperties body;
  body.mass = 2;
  body.inertia = Eigen::Vector3d(3, 4, 5).asDiagonal();  // int rho r r^T = diag(3, 2, 1)
  const std::vector<Eigen::Matrix3d> q = virials({}, body);
  REQUIRE(q.size() == 6);
  CHECK((q[2] - Eigen::Matrix3d(Eigen::Vector3d(3, 2, 0).asDiagonal())).norm() < 1e-14);  // Om_3^2: a = -(x, y, 0)
  CHECK((q[0] - Eigen::Matrix3d(Eigen::Vector3d(0, 2, 1).asDiagonal())).norm() < 1e-14);
  // The product Om_1 Om_2 causes no resultant moment on the free body, so that the antisymmetric part is zero.
  CHECK((q[5] - q[5].transpose()).norm() < 1e-14);
}

TEST_CASE("The stiffening of a beam that is accelerated by a pull is that of the linear tension") {
  // A unit force along x on end b of a free beam causes N(x) = x / L. The shape u_z of a unit displacement of b is
  // Hermite's 3 s^2 - 2 s^3: int N u'^2 dx = 36/L int s (s - s^2)^2 ds = 0.6 / L. A unit displacement of a has the same
  // u'^2, and hence the same value.
  const Mesh mesh = test::box_mesh(beam);
  const Superelement body = test::reduced(mesh, test::steel_body(Tie::average, Tie::average));
  const Eigen::MatrixXd& k = body.load_stiffness[6];
  // Shear and the finite width change the shape by (h / L)^2 = 4e-4, and the mesh changes it less.
  CHECK(k(8, 8) == Approx(0.6).epsilon(3e-3));
  CHECK(k(7, 7) == Approx(0.6).epsilon(3e-3));
  CHECK(k(2, 2) == Approx(0.6).epsilon(3e-3));
  CHECK(k(2, 8) == Approx(-0.6).epsilon(3e-3));
  // The same force on end a compresses the beam: N(x) = -(1 - x / L).
  CHECK(body.load_stiffness[0](8, 8) == Approx(-0.6).epsilon(3e-3));
  // A unit slope at b (positive ry moves z down) is u = -(s^3 - s^2) L, with int N u'^2 = L int s (3 s^2 - 2 s)^2 ds =
  // L (9/6 - 12/5 + 1).
  CHECK(k(10, 10) == Approx(0.1).epsilon(3e-3));
}

TEST_CASE("A beam that spins about a transverse axis has the tension N = rho A (L^2/4 - r^2)/2") {
  // The shape of end b is the same Hermite polynomial; with N = rho A L^2 (s - s^2) / 2, int N u'^2 dx = 18 rho A L int
  // (s - s^2)^3 ds = 18/140 rho A L.
  const Mesh mesh = test::box_mesh(beam);
  const Superelement body = test::reduced(mesh, test::steel_body(Tie::average, Tie::average));
  const double expected = 18.0 / 140 * body.total_mass;
  CHECK(body.spin_stiffness[2](8, 8) == Approx(expected).epsilon(3e-3));  // spin about z, bending along z
  CHECK(body.spin_stiffness[2](7, 7) == Approx(expected).epsilon(3e-3));
  CHECK(body.spin_stiffness[1](7, 7) == Approx(expected).epsilon(3e-3));
  CHECK(std::abs(body.spin_stiffness[0](7, 7)) < 1e-2 * expected);  // a spin about its own axis has nearly no effect
}

TEST_CASE("An arm between surface and interface node has the stiffness of a pendulum under load") {
  // The node of interface b is 0.5 m beyond the end of the beam and pulled along x. A rotation theta of the interface
  // about its node moves the end of the arm. The body is compared with the one whose node is on the surface, where
  // d_surface = d + (exp(theta) - I) (-arm): the energies must agree to second order in d and theta.
  const Mesh mesh = test::box_mesh(beam);
  const Tie tie = GENERATE(Tie::rigid, Tie::average);
  ReductionOptions options = test::steel_body(Tie::average, tie);
  const Superelement at_surface = test::reduced(mesh, options);
  const Eigen::Vector3d arm(0.5, 0, 0);
  options.interfaces[1].position = at_surface.interfaces[1].position + arm;
  const Superelement at_arm = test::reduced(mesh, options);
  // A force F along x, in line with the arm, causes the same stress in both bodies. The second-order part of d_surface
  // is -theta x (theta x arm) / 2, and the work of F on it gives H = F.arm I - sym(F arm^T) for the rotations.
  Eigen::MatrixXd transform = Eigen::MatrixXd::Identity(12, 12);
  transform.block<3, 3>(6, 9) = skew(arm);
  Eigen::MatrixXd expected = transform.transpose() * at_surface.load_stiffness[6] * transform;
  expected.bottomRightCorner<3, 3>() += Eigen::Vector3d(0, 0.5, 0.5).asDiagonal();
  CHECK((at_arm.load_stiffness[6] - expected).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("The elastic energy to third order does not depend on the frame, for any ties and kept directions") {
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
  CHECK(objectivity() < 1e-10);  // rounding of the factorisation
  // An error of a tenth of one matrix must be detected.
  body.load_stiffness[7] *= 1.1;
  CHECK(objectivity() > 1e-4);
}
