// Frequencies of a cantilever that turns about the inertial z axis, against speed and hub radius.
//
// A. Wright, C. Smith, R. Thresher, J. Wang, J. Appl. Mech. 49 (1982) 197; here by power series of 60 digits
// (tests/references/rotating_beam.py): Bernoulli beam without rotary inertia and Coriolis forces. mu = omega sqrt(m
// L^4/EI), eta = Omega sqrt(m L^4/EI); in the plane of rotation mu^2 is less by eta^2.
//
// Linearisation about steady rotation, in axes that turn with omega: perturbations (dx, dTheta) of a node have
//     dv = dx' + w~ dx,              dOmega = dTheta' + Omega~ dTheta,
//     da = dx'' + 2 w~ dx' + w~ w~ dx,   dOmegadot = dTheta'' + Omega~ dTheta'
// so that K + C G + M H, C + M G', M with G, H, G' from these govern the vibrations.
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/dense/dense_products.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "tests/support/dense_solution.hpp"
#include "tests/support/eigenvalues.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::StaticModel;

namespace {

/// L = m = EI = 1; stretch, shear and rotary inertia change the frequencies by less than 1e-6.
struct RotatingBeam : StaticModel {
  Vector3 omega;
  RotatingBeam(int elements, double eta, double hub)
      : StaticModel(fmt::format(
            "nodes: {{root: {{position: [{0}, 0, 0], fixed: true}}, tip: {{position: [{0} + 1, 0, 0]}}}}\n"
            "elements: {{b: {{type: beam, nodes: [root, tip], elements: {1}, orientation: [0, 1, 0], section: {{EA: "
            "1e7, GAy: "
            "1e7, GAz: 1e7, GJ: 1, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 1e-7, Jy: 1e-7, Jz: 1e-7}}}}}}\n",
            hub, elements)),
        omega(0, 0, eta) {
    for (int iteration = 0; iteration < 8; ++iteration) {
      set_rates();
      VectorX step = VectorX::Zero(dense.size());
      step(free) = -bielle::test::solution(stiffness(), dense.residual(state)(free));
      dense.move(state, step);
    }
    set_rates();
    const VectorX r = dense.residual(state)(free);
    REQUIRE(r.norm() < 1e-6);
  }

  void set_rates() {
    for (NodeState& n : state.nodes) {
      n.v = omega.cross(n.x);
      n.a = omega.cross(n.v);
      n.Omega = n.R.transpose() * omega;
    }
  }
  MatrixX per_node(const std::function<Matrix3(const NodeState&)>& translation,
                   const std::function<Matrix3(const NodeState&)>& rotation) const {
    MatrixX all = MatrixX::Zero(dense.size(), dense.size());
    for (int k = 0; k < dense.nodes(); ++k) {
      all.block<3, 3>(6 * k, 6 * k) = translation(state.nodes[static_cast<std::size_t>(k)]);
      all.block<3, 3>(6 * k + 3, 6 * k + 3) = rotation(state.nodes[static_cast<std::size_t>(k)]);
    }
    return all;
  }
  MatrixX stiffness() const {
    const auto w = [&](const NodeState&) { return skew(omega); };
    const auto ww = [&](const NodeState&) { return Matrix3(skew(omega) * skew(omega)); };
    const auto W = [](const NodeState& n) { return skew(n.Omega); };
    const auto none = [](const NodeState&) { return Matrix3(Matrix3::Zero()); };
    const MatrixX K = dense.tangent(state, DenseModel::Part::K) +
                      dense.tangent(state, DenseModel::Part::C) * per_node(w, W) +
                      dense.tangent(state, DenseModel::Part::M) * per_node(ww, none);
    return K(free, free);
  }
  MatrixX damping() const {
    const auto w = [&](const NodeState&) { return Matrix3(2 * skew(omega)); };
    const auto W = [](const NodeState& n) { return skew(n.Omega); };
    const MatrixX C =
        dense.tangent(state, DenseModel::Part::C) + dense.tangent(state, DenseModel::Part::M) * per_node(w, W);
    return C(free, free);
  }
  /// Returns the frequencies of the vibrations in the given directions, ascending.
  std::vector<double> frequencies(const std::vector<int>& directions) {
    keep_directions(directions);
    const auto n = static_cast<Eigen::Index>(free.size());
    const MatrixX M = dense.tangent(state, DenseModel::Part::M)(free, free);
    const MatrixX inverse_mass = bielle::regular_inverse(M).value();
    MatrixX companion = MatrixX::Zero(2 * n, 2 * n);
    companion.topRightCorner(n, n).setIdentity();
    companion.bottomLeftCorner(n, n) = -bielle::product(inverse_mass, stiffness());
    companion.bottomRightCorner(n, n) = -bielle::product(inverse_mass, damping());
    std::vector<double> list;
    for (const std::complex<double>& value : bielle::test::eigenvalues(companion))
      if (value.imag() > 0) list.push_back(value.imag());
    std::sort(list.begin(), list.end());
    return list;
  }
};

const std::vector<int> flap{2, 3, 4}, lag{0, 1, 5};

}  // namespace

TEST_CASE("a rotating cantilever stiffens with its speed as it should") {
  const bielle::test::ReferenceTable exact("rotating_beam");
  for (const int eta : {0, 1, 2, 3, 4, 5, 6, 8, 10, 12}) {
    const double mu1 = exact(fmt::format("{}.flap_1", eta)), mu2 = exact(fmt::format("{}.flap_2", eta));
    const std::vector<double> across = RotatingBeam(16, eta, 0).frequencies(flap),
                              along = RotatingBeam(16, eta, 0).frequencies(lag);
    CAPTURE(eta, across[0], across[1], along[0], along[1]);
    // 16 elements have errors of 2.5e-5 and 5.5e-5 at the highest speed, which are of fourth order. In the plane the
    // first error is six times as large, because eta^2 is subtracted.
    CHECK_THAT(across[0], Catch::WithinRel(mu1, 3e-5));
    CHECK_THAT(across[1], Catch::WithinRel(mu2, 7e-5));
    CHECK_THAT(along[0], Catch::WithinRel(std::sqrt(mu1 * mu1 - eta * eta), 2e-4));
    CHECK_THAT(along[1], Catch::WithinRel(std::sqrt(mu2 * mu2 - eta * eta), 7e-5));
  }
  CHECK_THAT(RotatingBeam(16, 12, 1).frequencies(flap)[0], Catch::WithinRel(exact("12.hub.flap_1"), 2e-4));
}

TEST_CASE("frequencies of a rotating beam converge with the fourth power of the element length") {
  const double exact = bielle::test::ReferenceTable("rotating_beam")("6.flap_1");
  std::vector<double> errors;
  for (int elements : {2, 4, 8}) errors.push_back(RotatingBeam(elements, 6, 0).frequencies(flap)[0] / exact - 1);
  CAPTURE(errors);
  CHECK(std::log2(errors[0] / errors[1]) > 3.5);
  CHECK(std::log2(errors[1] / errors[2]) > 3.5);
}
