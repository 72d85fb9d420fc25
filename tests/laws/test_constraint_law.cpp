// Law 4: constraint rows have the gradient B, reactions are B^T lambda, and the rates of the rows are theirs along the
// motion.
#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;
using bielle::mechanism::ConstraintKind;
using bielle::test::derivative;

TEST_CASE("law 4: reactions are the transposed gradients of the constraints, and rates follow the motion") {
  for (const Sample& sample : samples())
    for (const Subject& subject : subjects(sample)) {
      const DenseModel& dense = *subject.dense;
      const int begin = dense.multiplier_begin(), count = dense.own_multipliers(), dofs = dense.first_order_begin();
      if (count == 0) continue;
      for (const NamedState& named : law_states(subject)) {
        CAPTURE(title(sample), named.name);
        const MatrixX K = dense.tangent(named.state, DenseModel::Part::K),
                      C = dense.tangent(named.state, DenseModel::Part::C);
        const auto rows = [&](double s) -> VectorX {
          return dense.residual(dense.along_motion(named.state, s / subject.scales.rate)).segment(begin, count);
        };
        const auto row_rates = [&](double s) -> VectorX {
          VectorX velocity, ignored;
          dense.constraint_rates(dense.along_motion(named.state, s / subject.scales.rate), velocity, ignored);
          return velocity;
        };
        VectorX velocity, acceleration;
        dense.constraint_rates(named.state, velocity, acceleration);
        const VectorX Phi = rows(0), Phi_rate = subject.scales.rate * derivative(rows);
        const VectorX second = subject.scales.rate * derivative(row_rates);
        for (int k = 0; k < count; ++k) {
          CAPTURE(k);
          const bool holonomic = dense.constraint_kind(k) == ConstraintKind::holonomic;
          const VectorX B = (holonomic ? K : C).row(begin + k).head(dofs).transpose();
          CHECK((K.col(begin + k).head(dofs) - B).cwiseAbs().maxCoeff() <= 1e-14 * B.cwiseAbs().maxCoeff());
          // Accuracy of differences: 1e-12 of the size of the rows (finite_difference.hpp).
          const double size = B.cwiseAbs().maxCoeff() * subject.scales.length * (1 + subject.scales.rate);
          CHECK_THAT(velocity[k], Catch::WithinAbs(holonomic ? Phi_rate[k] : Phi[k], 1e-11 * size));
          CHECK_THAT(acceleration[k], Catch::WithinAbs(second[k], 1e-11 * size * (1 + subject.scales.rate)));
        }
      }
    }
}
