#include "mechanism/solvers/start/massless_direction.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"

namespace bielle::mechanism {

std::optional<Vector6> massless_direction(const System& system, const std::vector<double>& mass, int node) {
  const NodeFreedom& freedom = system.kinematics().freedom(node);
  if (!freedom.all_free) return {};
  Matrix6 M = Matrix6::Zero();
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const int place = system.pattern().find(freedom.begin + row, freedom.begin + column);
      if (place >= 0) M(row, column) = mass[static_cast<std::size_t>(place)];
    }
  if (M.diagonal().minCoeff() <= 0) return {};
  const Vector6 scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const SymmetricEigenpairs eigen = symmetric_eigenpairs(scale.asDiagonal() * M * scale.asDiagonal());
  constexpr double rounding = 1e-12;
  if (eigen.values[0] > rounding) return {};
  const Vector6 direction = scale.asDiagonal() * eigen.vectors.col(0);
  Eigen::Index largest = 0;
  direction.tail<3>().cwiseAbs().maxCoeff(&largest);  // the sign is arbitrary
  return direction / std::copysign(direction.tail<3>().norm(), direction[3 + largest]);
}

std::string massless_name(const System& system, int node, const Vector6& direction) {
  // Rounding residues are printed as zero.
  const Vector3 axis = direction.tail<3>().unaryExpr([](double x) { return std::abs(x) < 1e-14 ? 0.0 : x; });
  return fmt::format("rotation of node '{}' about ({:.6g}, {:.6g}, {:.6g}) in its axes", system.model().node(node).name,
                     axis.x(), axis.y(), axis.z());
}

namespace {

/// A node with a direction about which it has no inertia.
struct Massless {
  int node;
  Vector6 direction;
  double left = 0, size = 0;  ///< largest entry of (all its rows)^T direction, and largest term of such an entry
};

/// Adds the products of these nodes' rows with the directions, column by column. @param at_row  index in `nodes` of
/// each unknown, or -1
void measure_hold(const System& system, const std::vector<double>& values, const std::vector<int>& at_row,
                  std::vector<Massless>& nodes) {
  const SparsePattern& pattern = system.pattern();
  int column_before = -1;
  std::vector<double> sums(nodes.size(), 0.0);
  std::vector<std::size_t> touched;
  const auto finish_column = [&] {
    for (const std::size_t k : touched) {
      nodes[k].left = std::max(nodes[k].left, std::abs(sums[k]));
      sums[k] = 0;
    }
    touched.clear();
  };
  pattern.for_each([&](int place, int row, int column) {
    if (column != column_before) finish_column();
    column_before = column;
    if (at_row[static_cast<std::size_t>(row)] < 0) return;
    const auto k = static_cast<std::size_t>(at_row[static_cast<std::size_t>(row)]);
    const int begin = system.kinematics().freedom(nodes[k].node).begin;
    const double term = nodes[k].direction[row - begin] * values[static_cast<std::size_t>(place)];
    if (touched.empty() || touched.back() != k) touched.push_back(k);
    sums[k] += term;
    nodes[k].size = std::max(nodes[k].size, std::abs(term));
  });
  finish_column();
}

}  // namespace

void check_massless_directions(const System& system, const State& state) {
  // The state is at rest and without loads, because a load that rotates with the node would seem to hold it.
  State still = state;
  system.set_rates(still, VectorX::Zero(system.dofs()), VectorX::Zero(system.dofs()));
  Environment unloaded;
  unloaded.load_factor = 0;
  std::vector<double> values;
  system.tangent(still, unloaded, {0, 0, 1, 0, 0}, nullptr, values);
  std::vector<Massless> nodes;
  std::vector<int> at_row(static_cast<std::size_t>(system.size()), -1);
  for (int node = 0; node < static_cast<int>(system.model().nodes().size()); ++node)
    if (const auto direction = massless_direction(system, values, node)) {
      std::fill_n(at_row.begin() + system.kinematics().freedom(node).begin, 6, static_cast<int>(nodes.size()));
      nodes.push_back({node, *direction});
    }
  if (nodes.empty()) return;
  system.tangent(still, unloaded, {1, 1, 1, 1, 1}, nullptr, values);
  measure_hold(system, values, at_row, nodes);
  constexpr double rounding = 1e-12;
  for (const Massless& each : nodes)
    if (each.left <= rounding * each.size) throw_massless(massless_name(system, each.node, each.direction), "inertia");
}

}  // namespace bielle::mechanism
