// Geometric stiffness of a reduced beam that spins: centrifugal stiffening against the Euler-Bernoulli beam.
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "reduce/reduction/reduced_matrices.hpp"
#include "reduce/reduction/rigid_motions.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

/// Returns a beam along x, 1 m x 20 mm x 20 mm. Without contraction a held end suppresses nothing, as in the theory of
/// beams.
Superelement beam(Tie a) {
  ReductionOptions options;
  options.name = "beam";
  options.materials = {{"steel", Material::isotropic(210e9, 0, 7800)}};
  options.regions = {{"all", "steel"}};
  options.interfaces.resize(2);
  options.interfaces[0].name = options.interfaces[0].group = "x0";
  options.interfaces[1].name = options.interfaces[1].group = "x1";
  options.interfaces[0].tie = a;
  options.interfaces[1].tie = Tie::average;
  options.modes.count = 12;
  Progress quiet(true);
  return reduce_body(test::box_mesh({{1, 0.02, 0.02}, {64, 1, 1}}), options, quiet, 2);
}

/// int (1/4 - s^2)/2 phi'^2 ds / int phi^2 ds of a free-free mode of length 1: the contribution of spin about a
/// transverse axis to omega^2 / Omega^2 out of its plane (the mode's own change adds less than a percent).
double tension_quotient(double beta) {
  const double ratio = (std::cosh(beta) - std::cos(beta)) / (std::sinh(beta) - std::sin(beta));
  double tension = 0, mass = 0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double s = (i + 0.5) / steps, x = beta * s;
    const double phi = std::cosh(x) + std::cos(x) - ratio * (std::sinh(x) + std::sin(x));
    const double slope = beta * (std::sinh(x) - std::sin(x) - ratio * (std::cosh(x) + std::cos(x)));
    tension += (0.25 - (s - 0.5) * (s - 0.5)) / 2 * slope * slope;
    mass += phi * phi;
  }
  return tension / mass;
}

}  // namespace

TEST_CASE(
    "Free-free modes of a spinning beam stiffen as its tension says, out of the plane of spin and about no other "
    "axis") {
  const Superelement body = beam(Tie::average);
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(body.size(), 6);
  rigid.topRows(12) = interface_rigid_motions(body.interfaces, body.centre);
  const FreeModes modes = free_modes(body.stiffness, body.mass, rigid);
  // The square section has pairs of modes in any two planes: take the plane's directions by the spin matrices' own
  // pairs.
  for (const auto& [first, beta] : {std::pair{0, 4.7300407448627}, {2, 7.8532046240958}}) {
    const Eigen::MatrixXd pair = modes.vectors.middleCols(first, 2);
    const double expected = tension_quotient(beta);
    // Tension is the same for spin about y and about z, whichever way the beam bends; 0.5 % for shear and section.
    for (const int spin : {1, 2}) {
      const Eigen::Matrix2d stiffening = pair.transpose() * body.spin_stiffness[spin] * pair;
      const Eigen::Vector2d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(stiffening).eigenvalues();
      CHECK(values(0) == Approx(expected).epsilon(5e-3));
      CHECK(values(1) == Approx(expected).epsilon(5e-3));
    }
    // In the plane of spin the centrifugal force on the displacement itself softens by 1: H_33 = S_11 + S_22.
    const Eigen::Matrix2d in_plane =
        pair.transpose() * (body.inertia_components[0] + body.inertia_components[1]) * pair;
    const Eigen::Vector2d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(in_plane).eigenvalues();
    CHECK(values(0) < 5e-3);
    CHECK(values(1) == Approx(1).epsilon(5e-3));
  }
  // A geometrically exact beam has 3.04 and 6.38.
  CHECK(tension_quotient(4.7300407448627) == Approx(3.04).margin(0.01));
  CHECK(tension_quotient(7.8532046240958) == Approx(6.38).margin(0.06));
}

TEST_CASE("A rotating cantilever's flap and lag frequencies are those of Wright and of Hodges and Rutkowski") {
  // J. R. Wright et al., J. Appl. Mech. 49 (1982) 197; D. H. Hodges, M. J. Rutkowski, AIAA J. 19 (1981) 1459.
  // mu = omega sqrt(m L^4 / EI), eta likewise of the spin; no hub (tests/references/rotating_beam.py).
  const Superelement body = beam(Tie::rigid);
  const double length = 1, mass_per_length = body.total_mass / length;
  const double unit = std::sqrt(210e9 * std::pow(0.02, 4) / 12 / (mass_per_length * std::pow(length, 4)));  // [rad/s]
  std::vector<int> loose(body.size() - 6);
  for (std::size_t k = 0; k < loose.size(); ++k) {
    loose[k] = static_cast<int>(k) + 6;  // the root at x = 0 is held
  }
  const auto lowest = [&](double eta, bool lag, bool tension = true) {
    const double spin = eta * unit;
    // The stress is that of the free body that spins about its centre, plus that of the root's pull, which keeps the
    // centre on its circle: F = -m spin^2 L / 2.
    Eigen::MatrixXd k = body.stiffness;
    if (tension) {
      k += spin * spin * body.spin_stiffness[2] - body.total_mass * spin * spin * length / 2 * body.load_stiffness[0];
    }
    if (lag) {
      k -= spin * spin * (body.inertia_components[0] + body.inertia_components[1]);
    }
    const Eigen::MatrixXd m = body.mass;
    const bielle::SymmetricEigenpairs eigen =
        bielle::symmetric_eigenpairs(Eigen::MatrixXd(k(loose, loose)), Eigen::MatrixXd(m(loose, loose))).value();
    return Eigen::VectorXd(eigen.values.head(4).cwiseSqrt() / unit);
  };
  const test::ReferenceTable exact("rotating_beam");
  const double at_rest = lowest(0, false)(0) / exact("0.flap_1");  // shear takes 3e-4, the mesh adds 1e-3
  CHECK(at_rest == Approx(1).epsilon(2e-3));
  // These are the two bending planes: flap is the higher frequency of each pair, because lag is softened.
  for (const int eta : {1, 3, 6}) {
    const double flap = exact(std::to_string(eta) + ".flap_1"), second = exact(std::to_string(eta) + ".flap_2");
    const Eigen::VectorXd found = lowest(eta, false);
    CHECK(found(0) == Approx(flap).epsilon(3e-3));
    CHECK(found(2) == Approx(second).epsilon(5e-3));
    const Eigen::VectorXd lagging = lowest(eta, true);
    CHECK(lagging(0) == Approx(std::sqrt(flap * flap - eta * eta)).epsilon(3e-3));
    CHECK(lagging(1) == Approx(flap).epsilon(3e-3));
  }
  // The tension matters: without it flap does not depend on the spin, and lag loses its stiffness at eta = mu1.
  CHECK(lowest(3, false, false)(0) == Approx(exact("0.flap_1")).epsilon(2e-3));
  CHECK(lowest(3, true, false)(0) == Approx(std::sqrt(std::pow(exact("0.flap_1"), 2) - 9)).epsilon(1e-2));
}
