// A flexible beam thrown into the air of no gravity: energy and momenta drift with the order of the integrator only. (A
// unit test, tests/unit/mechanism/elements/test_beam_inertia.cpp, proves that their rates vanish to rounding at any
// state.)
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/dense_model.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

/// Returns energy, momentum and angular momentum about the inertial origin.
Eigen::Matrix<double, 7, 1> invariants(const DenseModel& dense, const State& state) {
  const VectorX p = dense.tangent(state, DenseModel::Part::M) * dense.rates(state);
  const Energy energy = dense.energy(state);
  Eigen::Matrix<double, 7, 1> all = Eigen::Matrix<double, 7, 1>::Zero();
  all[0] = energy.kinetic + energy.elastic;
  for (int k = 0; k < dense.nodes(); ++k) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(k)];
    all.segment<3>(1) += p.segment<3>(6 * k);
    all.segment<3>(4) += node.x.cross(p.segment<3>(6 * k)) + node.R * p.segment<3>(6 * k + 3);
  }
  return all;
}

}  // namespace

TEST_CASE("a tumbling flexible beam keeps its energy and momenta to the second order of the step") {
  // The ends start with different velocities, so that the beam bends, twists and stretches while it tumbles.
  const ReadyModel model(R"yaml(
nodes:
  a: {position: [0, 0, 0], velocity: [0.2, -0.5, 0.3], angular_velocity: [0.6, 1, 4]}
  b: {position: [1, 0, 0], velocity: [0.2, 3.6, -1.1], angular_velocity: [1.6, 1, 3]}
elements:
  rod: {type: beam, nodes: [a, b], elements: 8, orientation: [0, 1, 0], section: {EA: 1e4, GAy: 4e3, GAz: 4e3, GJ: 0.8, EIy: 1.3, EIz: 1, mass_per_length: 1, Jx: 2e-3, Jy: 1e-3, Jz: 1e-3}}
)yaml");
  const DenseModel dense(model.file.model);
  const Eigen::Matrix<double, 7, 1> start = invariants(dense, model.system.start(0));
  std::vector<double> energy, momentum, angular;
  for (double h : {4e-3, 2e-3, 1e-3}) {
    double worst_energy = 0, worst_momentum = 0, worst_angular = 0;
    integrate(model, Scheme::generalized_alpha(0.9), h, 1, [&](const State& state) {
      const Eigen::Matrix<double, 7, 1> change = invariants(dense, state) - start;
      worst_energy = std::max(worst_energy, std::abs(change[0]));
      worst_momentum = std::max(worst_momentum, change.segment<3>(1).norm());
      worst_angular = std::max(worst_angular, change.segment<3>(4).norm());
    });
    energy.push_back(worst_energy / start[0]);
    momentum.push_back(worst_momentum / start.segment<3>(1).norm());
    angular.push_back(worst_angular / start.segment<3>(4).norm());
  }
  CAPTURE(energy, momentum, angular);
  for (const auto& drift : {energy, momentum, angular}) {
    CHECK(drift[2] < 1e-3);
    CHECK(std::log2(drift[1] / drift[2]) > 1.7);
  }
}
