// Plates: the completely free one against an exact mode and thin-plate theory, the cantilever (fixed-boundary modes of
// a superelement with one interface) against thin-plate theory and against its own fine mesh.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "reduce/reduction/reduce_body.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace test_plates {
namespace {

constexpr double young = 200e9, poisson = 0.3, density = 8000, side = 10;

/// Returns the frequency [Hz] of a thin square plate with omega a^2 sqrt(rho h / D) = lambda.
double thin_plate(double lambda, double thickness) {
  return lambda / (2 * std::numbers::pi * side * side) * thickness *
         std::sqrt(young / (12 * (1 - poisson * poisson) * density));
}

Mesh plate(int along, int through, double thickness) {
  return test::box_mesh({{side, side, thickness}, {along, along, through}});
}

}  // namespace

TEST_CASE("A free plate, exactly: Lame's mode from above with order four") {
  // u = (cos px sin py, -sin px cos py, 0), p = pi / a, leaves all faces of a square plate free of stress, whatever its
  // thickness: f = sqrt(G / rho) / (sqrt(2) a).
  const double exact = std::sqrt(young / 2.6 / density) / (std::sqrt(2.0) * side);
  Eigen::Vector3d errors;
  for (int level = 0; level < 3; ++level) {
    const test::SolidModel model(plate(4 << level, 1, 1), Material::isotropic(young, poisson, density));
    const Eigen::VectorXd found = model.frequencies(24);
    const double nearest = *std::min_element(
        found.begin(), found.end(), [&](double a, double b) { return std::abs(a - exact) < std::abs(b - exact); });
    errors(level) = nearest / exact - 1;
  }
  INFO(errors.transpose());
  CHECK(errors.minCoeff() > 0);
  CHECK(std::log2(errors(0) / errors(1)) > 3.6);
  CHECK(std::log2(errors(1) / errors(2)) > 3.6);
}

TEST_CASE("Bending of a free plate and of a cantilever plate: falling with the mesh to the thin plate's frequencies") {
  // Thin plates of Poisson's ratio 0.3, omega a^2 sqrt(rho h / D): free, D. J. Gorman, J. Sound Vib. 57 (1978) 437;
  // cantilever, A. W. Leissa, J. Sound Vib. 31 (1973) 257, Ritz's upper bounds. Shear and rotary inertia of a plate of
  // thickness a / 40 take 0.1 to 0.5 %; the mesh adds less than 1 %, most where the clamped edge ends.
  const double thickness = side / 40;
  Eigen::MatrixXd free_plate(3, 5), cantilever(3, 5);
  for (int level = 0; level < 3; ++level) {
    const Mesh mesh = plate(3 << level, 1, thickness);
    free_plate.row(level) =
        test::SolidModel(mesh, Material::isotropic(young, poisson, density)).frequencies(5).transpose();
    ReductionOptions options;
    options.name = "plate";
    options.materials = {{"steel", Material::isotropic(young, poisson, density)}};
    options.regions = {{"all", "steel"}};
    options.interfaces.resize(1);
    options.interfaces[0].name = options.interfaces[0].group = "x0";
    options.modes.count = 5;
    options.stress_recovery = RecoveryExtent::none;
    Progress quiet(true);
    cantilever.row(level) = reduce_body(mesh, options, quiet, 2).frequencies.transpose();
  }
  INFO(free_plate << "\n" << cantilever);
  const Eigen::Array<double, 5, 1> free_lambda{13.468, 19.596, 24.270, 34.801, 34.801};
  const Eigen::Array<double, 5, 1> held_lambda{3.4917, 8.5246, 21.429, 27.331, 31.111};
  for (int k = 0; k < 5; ++k) {
    for (const auto& [found, lambda] :
         {std::pair{free_plate.col(k).eval(), free_lambda(k)}, {cantilever.col(k).eval(), held_lambda(k)}}) {
      CHECK(found(0) > found(1));
      CHECK(found(1) > found(2));
      CHECK(found(2) == Approx(thin_plate(lambda, thickness)).epsilon(0.01));
    }
  }
}

}  // namespace test_plates
