// Law 1: K, C and M are the derivatives of the residual along increments on the group.
#include <catch2/catch.hpp>

#include "tests/laws/subject.hpp"
#include "tests/support/finite_difference.hpp"

using namespace bielle::laws;
using Part = DenseModel::Part;
using bielle::test::derivative;

namespace {

using Mover = void (DenseModel::*)(State&, const VectorX&) const;

/// Returns the derivatives of the residual along the unknowns that `move` changes, times their units.
MatrixX difference(const DenseModel& dense, const State& state, Mover move, const VectorX& units, double step) {
  MatrixX D = MatrixX::Zero(dense.size(), dense.size());
  for (int j = 0; j < dense.size(); ++j) {
    if (units[j] == 0) continue;
    D.col(j) = derivative(
        [&](double s) -> VectorX {
          State moved = state;
          (dense.*move)(moved, VectorX::Unit(dense.size(), j) * (s * units[j]));
          return dense.residual(moved);
        },
        step);
  }
  return D;
}

/// Returns the size of each row's terms: the largest entry of the rows of its kind (forces, moments, amplitudes, ...),
/// and the residual's, whose rounding the differences feel.
VectorX row_sizes(const DenseModel& dense, const MatrixX& A, const VectorX& r) {
  const VectorX entries = A.cwiseAbs().rowwise().maxCoeff() + r.cwiseAbs();
  VectorX sizes = entries;
  double force = 0, moment = 0;
  for (int node = 0; node < dense.nodes(); ++node) {
    force = std::max(force, entries.segment<3>(6 * node).maxCoeff());
    moment = std::max(moment, entries.segment<3>(6 * node + 3).maxCoeff());
  }
  for (int node = 0; node < dense.nodes(); ++node) {
    sizes.segment<3>(6 * node).setConstant(force);
    sizes.segment<3>(6 * node + 3).setConstant(moment);
  }
  return sizes;
}

void check_part(const Subject& subject, const Sample& sample, const State& state, Part part) {
  const DenseModel& dense = *subject.dense;
  const Mover mover = part == Part::K   ? &DenseModel::move
                      : part == Part::C ? &DenseModel::move_rates
                                        : &DenseModel::move_accelerations;
  const VectorX units = part == Part::K   ? subject.position_units()
                        : part == Part::C ? subject.rate_units()
                                          : VectorX(subject.scales.rate * subject.rate_units());
  const MatrixX tangent = dense.tangent(state, part) * units.asDiagonal();
  const MatrixX expected =
      difference(dense, state, mover, units, subject.scales.smooth_within * bielle::test::difference_step);
  double allowed_everywhere = 0;
  if (part != Part::M && (sample.neglected.K > 0 || sample.neglected.C > 0)) {
    const VectorX rates = dense.rates(state).cwiseQuotient(subject.position_units());
    const double w = rates.cwiseAbs().maxCoeff();
    const double mass = (dense.tangent(state, Part::M) * units.asDiagonal()).cwiseAbs().maxCoeff();
    allowed_everywhere = part == Part::K ? sample.neglected.K * w * w * mass : sample.neglected.C * w * mass;
  }
  // Differences are accurate to 1e-12 of the terms that make up a row (finite_difference.hpp); these exceed the entries
  // by the cancellation within a row, for which a factor of a thousand is allowed.
  const VectorX allowed =
      1e-9 * row_sizes(dense, expected, dense.residual(state)).array() + (allowed_everywhere + 1e-13);
  for (int i = 0; i < dense.size(); ++i)
    for (int j = 0; j < dense.size(); ++j) {
      if (std::abs(tangent(i, j) - expected(i, j)) <= allowed[i]) continue;
      CAPTURE(i, j, tangent(i, j), expected(i, j), allowed[i]);
      FAIL_CHECK("the tangent is not the derivative of the residual");
      return;  // one entry tells enough
    }
}

}  // namespace

TEST_CASE("law 1: tangents are the derivatives of residuals") {
  for (const Sample& sample : samples())
    for (const Subject& subject : subjects(sample))
      for (const NamedState& named : law_states(subject)) {
        CAPTURE(title(sample), named.name);
        const struct {
          Part part;
          const char* name;
        } parts[] = {{Part::K, "K"}, {Part::C, "C"}, {Part::M, "M"}};
        for (const auto& [part, name] : parts) {
          CAPTURE(name);
          check_part(subject, sample, named.state, part);
        }
      }
}
