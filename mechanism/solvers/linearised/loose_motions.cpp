#include "mechanism/solvers/linearised/loose_motions.hpp"

namespace bielle::mechanism {

void hold_loose(double rate, LinearisedEquations& equations) {
  constexpr double little = 1e-6;  // fraction of centrifugal forces
  VectorX sum = VectorX::Zero(2), count = sum;
  const VectorX inertia = equations.M.diagonal();
  const auto kind = [&](int i) { return equations.turns[static_cast<std::size_t>(i)] != 0 ? 1 : 0; };
  for (int i = 0; i < equations.dofs; ++i) {
    sum[kind(i)] += inertia[i];
    count[kind(i)] += inertia[i] > 0 ? 1 : 0;
  }
  VectorX missing = VectorX::Zero(equations.unknowns());
  for (int i = 0; i < equations.dofs; ++i)
    if (!(inertia[i] > 0) && count[kind(i)] > 0) missing[i] = sum[kind(i)] / count[kind(i)];
  equations.K += little * rate * rate * (equations.M + LinearisedEquations::Sparse(missing.asDiagonal()));
}

}  // namespace bielle::mechanism
