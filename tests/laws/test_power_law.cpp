// Law 3: the power that a component takes from the motion is the rate of its energy, plus what it dissipates, less what
// it puts in, plus that of its reactions on constraints that are not met:
//     r_q . qdot = d(T + V + V_gravity)/dt + dissipation - input + lambda . dPhi/dt
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;
using bielle::mechanism::Energy;

namespace {

/// Rates of first-order unknowns for which their equations hold (they are linear in the rates); algebraic ones have
/// none.
void satisfy_first_order(const DenseModel& dense, State& state) {
  const int begin = dense.first_order_begin();
  std::vector<int> rows;
  for (int k = begin; k < dense.multiplier_begin(); ++k)
    if (dense.is_algebraic(k - begin))
      state.first_order_rate[k - begin] = 0;
    else
      rows.push_back(k);
  if (rows.empty()) return;
  const MatrixX C = dense.tangent(state, DenseModel::Part::C)(rows, rows);
  const VectorX change = C.partialPivLu().solve(dense.residual(state)(rows));
  for (std::size_t k = 0; k < rows.size(); ++k)
    state.first_order_rate[rows[k] - begin] -= change[static_cast<Eigen::Index>(k)];
}

}  // namespace

TEST_CASE("law 3: power is the rate of energy plus dissipation less input") {
  for (const Sample& sample : samples()) {
    if (sample.has_no_power) continue;
    for (const Subject& subject : subjects(sample))
      for (NamedState& named : law_states(subject)) {
        CAPTURE(title(sample), named.name);
        const DenseModel& dense = *subject.dense;
        satisfy_first_order(dense, named.state);
        const int dofs = dense.first_order_begin();
        const VectorX r = dense.residual(named.state), v = dense.rates(named.state);
        VectorX Phi_rate, ignored;
        dense.constraint_rates(named.state, Phi_rate, ignored);
        const Energy energy = dense.energy(named.state);
        // The step is small, since the distance of two points may halve within 0.05/rate.
        const double stored = bielle::test::derivative(
            [&](double s) {
              const Energy later = dense.energy(dense.along_motion(named.state, s / subject.scales.rate));
              return subject.scales.rate * (later.kinetic + later.elastic + later.gravity);
            },
            0.005 * subject.scales.smooth_within);
        const double power = r.head(dofs).dot(v.head(dofs));
        const double expected = stored + energy.dissipation - energy.input + named.state.multiplier.dot(Phi_rate);
        // Differences of the energies are good to 1e-12 of the largest of them (finite_difference.hpp). Coordinates are
        // rounded to 2e-16: forces of order one, along steps of 0.005, then make some 1e-13 of a power of order one.
        const double size =
            r.head(dofs).cwiseProduct(v.head(dofs)).cwiseAbs().sum() +
            subject.scales.rate * (std::abs(energy.kinetic) + std::abs(energy.elastic) + std::abs(energy.gravity));
        CHECK_THAT(power, Catch::WithinAbs(expected, 1e-10 * size + 1e-13));
        CHECK(energy.dissipation >= -1e-14 * size);
      }
  }
}
