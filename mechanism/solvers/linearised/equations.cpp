#include "mechanism/solvers/linearised/equations.hpp"

#include <limits>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/system/unknown_groups.hpp"

namespace bielle::mechanism {
namespace {

using Sparse = LinearisedEquations::Sparse;
using Entries = std::vector<Eigen::Triplet<double>>;

void add_block(Entries& entries, int begin, const MatrixX& block) {
  for (int j = 0; j < block.cols(); ++j)
    for (int i = 0; i < block.rows(); ++i)
      if (block(i, j) != 0) entries.emplace_back(begin + i, begin + j, block(i, j));
}

/// Returns the effect of rotating axes on the free translations of a node. If some translations are held, they are also
/// held along the axes' motion, or the axes do not rotate: a node in a plane may rotate about its normal.
MatrixX turning_translations(const NodeFreedom& freedom, const Vector3& omega) {
  const int count = freedom.count - freedom.rotations;
  const MatrixX G = freedom.G.topLeftCorner(3, count);
  const MatrixX turned = skew(omega) * G;
  const MatrixX kept = G.transpose() * turned;
  const bool leaves = (turned - G * kept).norm() > 1e-12 * omega.norm();
  return leaves ? MatrixX::Zero(count, count) : kept;
}

/// Computes W and Z.
void turning_axes(const System& system, const State& state, ModeAxes axes, Sparse& W, Sparse& Z) {
  Entries w, z;
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    const NodeFreedom& freedom = system.kinematics().freedom(static_cast<int>(k));
    if (freedom.count == 0) continue;
    const NodeState& node = state.nodes[k];
    const int translations = freedom.count - freedom.rotations;
    // With a single axis of rotation, dTheta and Omega are parallel, and both terms vanish.
    const bool turns = freedom.rotations == 3;
    if (axes == ModeAxes::inertial) {
      if (turns) add_block(z, freedom.begin + translations, -skew(node.Omega));
      continue;
    }
    const MatrixX block = turning_translations(freedom, node.R * node.Omega);
    add_block(w, freedom.begin, block);
    add_block(z, freedom.begin, block);
    if (turns) add_block(w, freedom.begin + translations, skew(node.Omega));
  }
  W.setFromTriplets(w.begin(), w.end());
  Z.setFromTriplets(z.begin(), z.end());
}

/// Extracts the rows that are in the equations.
Sparse chosen_rows(const Sparse& A, const std::vector<int>& number) {
  Entries entries;
  for (int j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator it(A, j); it; ++it)
      if (const int row = number[static_cast<std::size_t>(it.row())]; row >= 0)
        entries.emplace_back(row, j, it.value());
  int rows = 0;
  for (const int each : number) rows += each >= 0 ? 1 : 0;
  Sparse chosen(rows, A.cols());
  chosen.setFromTriplets(entries.begin(), entries.end());
  return chosen;
}

void number_groups(const System& system, LinearisedEquations& equations) {
  const int n = equations.unknowns(), scalars = system.kinematics().unknowns();
  equations.group = unknown_groups(system, n);
  equations.turns.assign(static_cast<std::size_t>(n), 0);
  for (int i = 0; i < scalars; ++i) equations.turns[static_cast<std::size_t>(i)] = system.kind(i) == Kind::rotation;
}

/// Returns the residual, and the effect of rounding of positions, rotations and amplitudes on forces.
VectorX left_over(const System& system, const State& state, const Sparse& K, const VectorX& residual) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  VectorX sizes = VectorX::Zero(K.cols());
  const double length = model_length(state);
  const int scalars = system.kinematics().unknowns();
  for (int i = 0; i < scalars; ++i) sizes[i] = system.kind(i) == Kind::translation ? length : 1;
  sizes.segment(scalars, state.amplitude.size()) = state.amplitude.cwiseAbs();
  sizes.tail(state.first_order.size()) = state.first_order.cwiseAbs();
  const VectorX by_rounding = rounding * (K.cwiseAbs() * sizes);
  return residual.head(K.rows()).cwiseAbs().cwiseMax(by_rounding);
}

}  // namespace

LinearisedEquations linearised_equations(const System& system, const Environment& environment, const State& state,
                                         ModeAxes axes) {
  VectorX residual(system.size());
  system.residual(state, environment, residual);
  return linearised_equations(system, state, axes, linearise(system, environment, state), residual);
}

LinearisedEquations linearised_equations(const System& system, const State& state, ModeAxes axes,
                                         SystemMatrices matrices, const VectorX& residual) {
  LinearisedEquations equations;
  equations.dofs = system.dofs();
  const auto n = matrices.K.rows();
  std::vector<int> number(static_cast<std::size_t>(system.multipliers()), 0);
  system.for_each_idle(state, [&](int k) { number[static_cast<std::size_t>(k)] = -1; });
  for (int k = 0; k < system.multipliers(); ++k) {
    if (number[static_cast<std::size_t>(k)] < 0) continue;
    number[static_cast<std::size_t>(k)] = static_cast<int>(equations.multiplier.size());
    equations.multiplier.push_back(k);
    equations.nonholonomic.push_back(system.constraint_kind(k) == ConstraintKind::nonholonomic);
  }
  equations.B = chosen_rows(matrices.B, number);
  equations.S = chosen_rows(matrices.S, number);
  equations.F = Sparse(chosen_rows(Sparse(matrices.F.transpose()), number).transpose());
  equations.W.resize(n, n);
  Sparse Z(n, n);
  turning_axes(system, state, axes, equations.W, Z);
  equations.K = std::move(matrices.K);
  equations.M = std::move(matrices.M);
  equations.C = Sparse(matrices.C + equations.M * Z);
  number_groups(system, equations);
  equations.left_over = left_over(system, state, equations.K, residual);
  return equations;
}

}  // namespace bielle::mechanism
