#include <numbers>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/reduction/reduced_matrices.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

/// Two masses of 1 and 3 kg slide freely and are connected by a spring of 12 N/m: omega^2 = 12 (1 + 1/3).
const Eigen::Matrix2d stiffness = (Eigen::Matrix2d() << 12, -12, -12, 12).finished();
const Eigen::Matrix2d mass = (Eigen::Matrix2d() << 1, 0, 0, 3).finished();
const Eigen::MatrixXd rigid = Eigen::MatrixXd::Ones(2, 1);

}  // namespace

TEST_CASE("Free modes of two masses and a spring") {
  const FreeModes modes = free_modes(stiffness, mass, rigid);
  REQUIRE(modes.omega.size() == 1);
  CHECK(modes.omega(0) == Approx(4).epsilon(1e-14));
  CHECK(modes.vectors.col(0).dot(mass * modes.vectors.col(0)) == Approx(1).epsilon(1e-14));
  CHECK(modes.vectors(0, 0) == Approx(-3 * modes.vectors(1, 0)).epsilon(1e-13));
}

TEST_CASE("A rigid body has no elastic modes") {
  const FreeModes modes =
      free_modes(Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Ones(1, 1));
  CHECK(modes.omega.size() == 0);
}

TEST_CASE("Modal damping damps each elastic mode by its ratio and no rigid motion") {
  const FreeModes modes = free_modes(stiffness, mass, rigid);
  const Eigen::MatrixXd damping = modal_damping(modes, mass, {0.05});
  // A dashpot c between the masses causes zeta = c (1 + 1/3) / (2 omega), hence c = 0.05 * 2 * 4 / (4/3) = 0.3.
  CHECK((damping - 0.3 / 12 * stiffness).norm() < 1e-14);
  CHECK((damping * rigid).norm() < 1e-14);
  CHECK(modal_damping(modes, mass, {}).norm() == 0);
  CHECK_THROWS_WITH(modal_damping(modes, mass, {0.1, 0.2}),
                    Catch::Contains("2 values for a reduced body with 1 elastic mode"));
}

TEST_CASE("A list of ratios applies to the modes in order, its last ratio to all further modes") {
  const Eigen::Vector3d omega(1, 2, 3);
  const FreeModes modes{omega, Eigen::Matrix3d::Identity()};
  const Eigen::MatrixXd damping = modal_damping(modes, Eigen::Matrix3d::Identity(), {0.1, 0.02});
  CHECK((damping.diagonal() - Eigen::Vector3d(0.2, 0.08, 0.12)).norm() < 1e-15);
}

TEST_CASE("A mass matrix that is not positive definite is refused") {
  const Eigen::Matrix2d bad = (Eigen::Matrix2d() << 1, 2, 2, 1).finished();
  CHECK_THROWS_AS(free_modes(stiffness, bad, Eigen::MatrixXd(2, 0)), ComputationError);
}
