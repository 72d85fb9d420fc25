#include "mechanism/solvers/linearised/growing_motions.hpp"

#include "mechanism/math/negative_directions.hpp"
#include "mechanism/solvers/linearised/equation_symmetry.hpp"

namespace bielle::mechanism {
namespace {

using Sparse = LinearisedEquations::Sparse;

std::optional<int> count_negative(const LinearisedEquations& e, const Sparse& D) {
  const Sparse symmetric = 0.5 * (D + Sparse(D.transpose()));
  return count_negative_directions(symmetric, e.B, group_sizes(symmetric, e.B, e.group));
}

}  // namespace

std::optional<int> count_growing(const LinearisedEquations& e, double s) {
  if (equation_symmetry(e) != EquationSymmetry::symmetric) return {};
  const Sparse D = stiffness_in_axes(e) + s * damping_in_axes(e) + s * s * e.M;
  return count_negative(e, D);
}

std::optional<int> count_outweighed(const LinearisedEquations& e, double rate) {
  constexpr double little = 1e-6;
  if (!has_symmetric_stiffness(e)) return {};
  const Sparse D = stiffness_in_axes(e) + little * rate * rate * e.M;
  return count_negative(e, D);
}

}  // namespace bielle::mechanism
