// Frequencies of a superelement at rest and spinning: rotating frames are the touchstone of its inertia.
//
// The free-free beam of beam_superelement.hpp spins about z with Om; y is in the plane of rotation. Seen from a frame
// that spins with it, the exact inertia of a linear field softens in-plane bending, omega^2 - Om^2, and leaves bending
// across alone; tension of the centrifugal field stiffens both. Reference: (omega^2(Om) - omega^2(0)) / Om^2 by
// Ritz's method (tests/references/spinning_free_beam.py).
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/orthogonal_factors.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "tests/support/eigenvalues.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/superelement_alone.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

/// Frequencies [rad/s] of small motions relative to a body that turns with the constant Om about `centre`, about its
/// equilibrium, ascending. A free body has rigid ones: zero, and Om itself for nutation.
/// @param clamped  node 0 turns with Om rigidly
std::vector<double> spinning_frequencies(const SuperelementAlone& alone, const Vector3& Om, const Vector3& centre,
                                         bool clamped = false) {
  const auto n = alone.size();
  // Relative motions d, d', d'' of the nodes in body axes: velocity d' + Om~ d and so on for translations; for
  // rotations Omega = d' + Om~ d, Omegadot = d'' + Om~ d' to first order.
  MatrixX V_d = MatrixX::Zero(n, n), A_d = V_d, A_v = V_d;
  const Matrix3 S = skew(Om);
  for (int k = 0; k < alone.nodes(); ++k) {
    V_d.block<3, 3>(6 * k, 6 * k) = S;
    V_d.block<3, 3>(6 * k + 3, 6 * k + 3) = S;
    A_d.block<3, 3>(6 * k, 6 * k) = S * S;
    A_v.block<3, 3>(6 * k, 6 * k) = 2 * S;
    A_v.block<3, 3>(6 * k + 3, 6 * k + 3) = S;
  }
  std::vector<Eigen::Index> moving;
  for (Eigen::Index k = clamped ? 6 : 0; k < n; ++k) moving.push_back(k);
  State state = alone.rigid_state({-centre, Matrix3::Identity()});
  MatrixX K, C, M;
  for (int iteration = 0; iteration < 20; ++iteration) {
    for (NodeState& node : state.nodes) {
      node.v = Om.cross(node.x);
      node.a = Om.cross(node.v);
      node.Omega = node.R.transpose() * Om;
    }
    const SuperelementAlone::Tangent t = alone.tangent(state);
    K = (t.K + t.C * V_d + t.M * A_d)(moving, moving);
    C = (t.C + t.M * A_v)(moving, moving);
    M = t.M(moving, moving);
    // Rigid motions do not change the equilibrium: the smallest correction will do.
    const VectorX correction = bielle::least_squares(K, alone.residual(state)(moving));
    VectorX step = VectorX::Zero(n);
    step(moving) = correction;
    state = alone.moved(state, -step);
    if (step.norm() < 1e-11) break;
  }
  const auto m = static_cast<Eigen::Index>(moving.size());
  MatrixX first(2 * m, 2 * m);
  const MatrixX inverse_mass = bielle::regular_inverse(M).value();
  first << MatrixX::Zero(m, m), MatrixX::Identity(m, m), -bielle::product(inverse_mass, K),
      -bielle::product(inverse_mass, C);
  const Eigen::VectorXcd eigenvalues = bielle::test::eigenvalues(first);
  std::vector<double> frequencies;
  for (Eigen::Index k = 0; k < eigenvalues.size(); ++k)
    if (eigenvalues[k].imag() > 0) frequencies.push_back(eigenvalues[k].imag());
  std::sort(frequencies.begin(), frequencies.end());
  return frequencies;
}

/// Returns the four bending frequencies y1 z1 y2 z2 above `floor`.
std::array<double, 4> bending(const std::vector<double>& frequencies, double floor = 15) {
  std::array<double, 4> result{};
  std::size_t found = 0;
  for (double omega : frequencies)
    if (omega > floor && found < 4) result[found++] = omega;
  return result;
}

std::array<double, 4> spin_coefficients(const BeamChain& chain) {
  const BeamSuperelement reduced = chain.reduced();
  // Without geometric stiffness the frame matters, and the field of the references is linear in that of mean axes.
  const SuperelementAlone alone(reduced.body, {}, {}, chain.prestress ? BodyFrame::mean : BodyFrame::mean_axes);
  const auto at_rest = bending(spinning_frequencies(alone, Vector3::Zero(), reduced.body.centre));
  const auto spinning = bending(spinning_frequencies(alone, {0, 0, 4}, reduced.body.centre));
  std::array<double, 4> c{};
  for (std::size_t i = 0; i < 4; ++i) c[i] = (spinning[i] * spinning[i] - at_rest[i] * at_rest[i]) / 16;
  return c;
}

}  // namespace

TEST_CASE("frequencies at rest are those of the reduced matrices and converge to the free beam's") {
  for (int modes : {4, 16}) {
    const BeamSuperelement reduced = straight_beam({}, modes).reduced();
    const SuperelementAlone alone(reduced.body);
    const State state = alone.rigid_state({});
    const SuperelementAlone::Tangent t = alone.tangent(state);
    const VectorX placed = bielle::symmetric_eigenpairs(t.K, t.M)->values,
                  stored = bielle::symmetric_eigenpairs(reduced.body.stiffness, reduced.body.mass)->values;
    for (Eigen::Index k = 6; k < alone.size(); ++k) CHECK_THAT(placed[k], Catch::WithinRel(stored[k], 1e-9));
    // (beta L)^2 sqrt(EI / mass) of the free-free beam, beta L = 4.7300407, 7.8532046.
    const double exact[] = {22.3732854, 25.5095, 61.6728228, 70.3184};
    for (int i = 0; i < 4; ++i) {
      const double omega = std::sqrt(placed[6 + i]);
      CHECK(omega > exact[i] * (1 - 1e-5));
      // Published errors of four boundary unknowns and n exact fixed-boundary modes per plane: 3.6e-3 and 4.4e-3 with
      // n = 2, 1e-4 and 3e-4 with the six and more of 16.
      CHECK(omega < exact[i] * (1 + (modes == 4 ? 4.5e-3 : 4e-4)));
    }
  }
}

TEST_CASE("spin softens bending in its plane by its square and leaves bending across alone") {
  BeamChain chain = straight_beam();
  chain.prestress = false;
  const auto c = spin_coefficients(chain);
  // The radial growth of 16/EA of the length changes them in the fourth digit.
  CHECK_THAT(c[0], Catch::WithinAbs(-1, 5e-3));
  CHECK_THAT(c[1], Catch::WithinAbs(0, 5e-3));
  CHECK_THAT(c[2], Catch::WithinAbs(-1, 5e-3));
  CHECK_THAT(c[3], Catch::WithinAbs(0, 5e-3));
}

TEST_CASE("the tension of spin stiffens bending as in the geometrically exact beam") {
  const ReferenceTable table("spinning_free_beam");
  const std::array<double, 4> exact = {table("in_plane_1"), table("across_1"), table("in_plane_2"), table("across_2")};
  // The retained modes carry the tension: four to 2 per cent, twelve to 0.7 per cent.
  for (const auto& [modes, tolerance] : {std::pair{4, 0.02}, {12, 0.007}}) {
    CAPTURE(modes);
    const auto c = spin_coefficients(straight_beam({}, modes));
    for (std::size_t i = 0; i < 4; ++i) CHECK_THAT(c[i], Catch::WithinRel(exact[i], tolerance));
  }
}

TEST_CASE("a rotating blade has the frequencies of the rotating Euler-Bernoulli cantilever") {
  // A. D. Wright et al., J. Appl. Mech. 49 (1982) 197; values by tests/references/rotating_beam.py. Unit length, mass
  // per length and bending stiffness: omega = mu, Om = eta. In the plane of rotation omega^2 = flap^2 - Om^2.
  const ReferenceTable exact("rotating_beam");
  BeamProperties properties{1, 1e6, 1, 1, 1, 1e-6};
  const BeamSuperelement reduced = straight_beam(properties, 16).reduced();
  const SuperelementAlone alone(reduced.body);
  for (const int eta : {0, 1, 2, 3, 4, 5, 6}) {
    const double Om = eta, flap = exact(std::to_string(eta) + ".flap_1");
    const auto found = spinning_frequencies(alone, {0, 0, Om}, Vector3::Zero(), true);
    // The interface force at the root (load stiffness) and the free body's centrifugal field together are the blade's
    // tension. Eight modes in each plane carry it to 1e-4 at the highest speed.
    const double lag = std::sqrt(flap * flap - Om * Om);
    CHECK_THAT(found[0], Catch::WithinRel(lag, 2e-4));
    CHECK_THAT(found[1], Catch::WithinRel(flap, 2e-4));
  }
}
