#include "mechanism/solvers/statics/stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "mechanism/math/negative_directions.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"
#include "mechanism/system/unknown_groups.hpp"

namespace bielle::mechanism {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

const TangentWeights stiffness_alone{1, 0, 0, 0, 1, true};

/// Returns the largest magnitude in each unknown's group.
VectorX largest_of_groups(const std::vector<int>& group, const VectorX& x) {
  VectorX most = VectorX::Zero(group.back() + 1), result(static_cast<Eigen::Index>(group.size()));
  for (int i = 0; i < result.size(); ++i) {
    double& largest = most[group[static_cast<std::size_t>(i)]];
    largest = std::max(largest, std::abs(x[i]));
  }
  for (int i = 0; i < result.size(); ++i) result[i] = most[group[static_cast<std::size_t>(i)]];
  return result;
}

/// Removes entries that are rounding errors of others, because they would give sizes to unknowns without stiffness
/// (displacements of a rigid body).
void leave_rounding_out(const System& system, double length, Sparse& K) {
  constexpr double rounding = 1e-14;
  double translation = 0, rotation = 0;
  const VectorX diagonal = K.diagonal();
  for (int i = 0; i < diagonal.size(); ++i) {
    double* most = system.kind(i) == Kind::translation ? &translation
                   : system.kind(i) == Kind::rotation  ? &rotation
                                                       : nullptr;
    if (most) *most = std::max(*most, std::abs(diagonal[i]));
  }
  translation = std::max(translation, rotation / (length * length));
  const auto size = [&](Eigen::Index i) {
    const Kind kind = system.kind(static_cast<int>(i));
    return kind == Kind::translation ? translation : kind == Kind::rotation ? rotation : 0.0;
  };
  K.prune([&](Eigen::Index row, Eigen::Index column, double value) {
    return std::abs(value) > rounding * std::sqrt(size(row) * size(column));
  });
}

/// Increases sizes that are only rounding errors of others of their kind, so that they do not affect the result.
void raise_least(const System& system, VectorX& sizes) {
  constexpr double least = 1e-6;  // relative to the mean
  std::array<double, kind_count> sum{}, count{};
  for (int i = 0; i < system.dofs(); ++i) {
    sum[static_cast<std::size_t>(system.kind(i))] += sizes[i];
    count[static_cast<std::size_t>(system.kind(i))] += 1;
  }
  for (int i = 0; i < system.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system.kind(i));
    sizes[i] = std::max(sizes[i], least * sum[kind] / count[kind]);
  }
}

}  // namespace

Stability::Stability(const System& system, const VectorX* held)
    : system_(system),
      linear_(system),
      group_(unknown_groups(system, system.dofs())),
      held_(held ? *held : VectorX()) {}

/// Extracts the parts of the tangent. @returns no value if forces depend on first-order unknowns
std::optional<Stability::Parts> Stability::parts() {
  const std::vector<double>& values = linear_.values();
  const SparsePattern& pattern = linear_.pattern()->whole;
  const int dofs = system_.dofs(), first = system_.size() - system_.multipliers();
  std::vector<int> number(static_cast<std::size_t>(system_.multipliers()), -1);
  int constraints = 0;
  for (int k = 0; k < system_.multipliers(); ++k) {
    const int place = pattern.find(first + k, first + k);
    // A positive entry on the diagonal marks a constraint that is out of the equations.
    const bool out = place >= 0 && values[static_cast<std::size_t>(place)] > 0;
    if (!out) number[static_cast<std::size_t>(k)] = constraints++;
  }
  std::vector<Eigen::Triplet<double>> stiffness, rows, columns;
  int read = -1;  // a first-order unknown on which forces depend
  pattern.for_each([&](int place, int row, int column) {
    const double value = values[static_cast<std::size_t>(place)];
    if (value == 0 || (row >= dofs && row < first)) return;  // effects on first-order unknowns are not a stiffness
    if (column >= dofs && column < first) {
      read = column;
    } else if (row < dofs && column < dofs) {
      stiffness.emplace_back(row, column, value);
    } else if (row < dofs) {
      if (const int k = number[static_cast<std::size_t>(column - first)]; k >= 0) columns.emplace_back(k, row, value);
    } else if (column < dofs) {
      if (const int k = number[static_cast<std::size_t>(row - first)]; k >= 0) rows.emplace_back(k, column, value);
    }
  });
  if (read >= 0) {
    why_not_known_ = fmt::format("forces depend on {} of a controller, a differential equation or a fluid",
                                 system_.unknown_name(read));
    return {};
  }
  Parts parts{Sparse(dofs, dofs), Sparse(constraints, dofs), Sparse(constraints, dofs)};
  parts.K.setFromTriplets(stiffness.begin(), stiffness.end());
  parts.B.setFromTriplets(rows.begin(), rows.end());
  parts.B_of_forces.setFromTriplets(columns.begin(), columns.end());
  return parts;
}

/// Returns whether forces have a potential. Rotations of a node commute only if its moments balance: the residual
/// moments of an equilibrium are not counted as an asymmetry.
bool Stability::is_symmetric(const Parts& parts, const VectorX& sizes, const VectorX& left_over) {
  constexpr double asymmetry = 1e-7;  // relative to the sizes
  const auto differs_at = [this](Eigen::Index unknown) {
    why_not_known_ =
        fmt::format("the stiffness is not symmetric at {}", system_.unknown_name(static_cast<int>(unknown)));
    return false;
  };
  const Sparse difference = parts.K - Sparse(parts.K.transpose());
  for (int j = 0; j < difference.outerSize(); ++j)
    for (Sparse::InnerIterator it(difference, j); it; ++it) {
      const auto i = static_cast<int>(it.row());
      double most = asymmetry * std::sqrt(sizes[i] * sizes[j]);
      if (system_.kind(i) == Kind::rotation && system_.kind(j) == Kind::rotation)
        most += std::max(left_over[i], left_over[j]);
      if (std::abs(it.value()) > most) return differs_at(i);
    }
  VectorX row_sizes = VectorX::Zero(parts.B.rows());
  for (int j = 0; j < parts.B.outerSize(); ++j)
    for (Sparse::InnerIterator it(parts.B, j); it; ++it) row_sizes[it.row()] += it.value() * it.value() / sizes[j];
  const Sparse of_rows = parts.B - parts.B_of_forces;
  for (int j = 0; j < of_rows.outerSize(); ++j)
    for (Sparse::InnerIterator it(of_rows, j); it; ++it)
      if (std::abs(it.value()) > asymmetry * std::sqrt(row_sizes[it.row()] * sizes[j])) return differs_at(j);
  return true;
}

std::optional<int> Stability::count(const State& state, const Environment& environment) {
  if (system_.dofs() == 0) return 0;
  linear_.assemble(state, environment, stiffness_alone, nullptr);
  std::optional<Parts> tangent = parts();
  if (!tangent) return {};
  leave_rounding_out(system_, model_extent(state), tangent->K);
  VectorX sizes = group_sizes(tangent->K, tangent->B, group_), left_over(system_.size());
  raise_least(system_, sizes);
  residual_at_rest(system_, environment, state, left_over);
  if (!is_symmetric(*tangent, sizes, largest_of_groups(group_, left_over))) return {};
  Sparse K = 0.5 * (tangent->K + Sparse(tangent->K.transpose()));
  if (held()) K += Sparse(held()->asDiagonal());
  return count_negative_directions(K, tangent->B, sizes);
}

std::optional<Stability::Mode> Stability::softest(const State& state, const Environment& environment) {
  constexpr int most = 60;
  constexpr double settled = 1e-8;
  if (!linear_.try_factor(state, environment, stiffness_alone, nullptr, held())) return {};
  const double length = model_extent(state) > 0 ? model_extent(state) : 1;
  const int n = system_.dofs();
  VectorX weight(n);  // makes rotations and displacements comparable
  for (int i = 0; i < n; ++i) weight[i] = system_.kind(i) == Kind::translation ? 1 / (length * length) : 1;
  VectorX v = VectorX::Zero(system_.size()), load = VectorX::Zero(system_.size());
  // The start vector is not symmetric: a symmetric one would miss antisymmetric shapes.
  for (int i = 0; i < n; ++i) load[i] = 1 + 0.618 * std::sin(1.0 + 2.399963 * i);
  double before = 0, stiffness = 0;
  for (int iteration = 0; iteration < most; ++iteration) {
    linear_.solve(-load, v);
    const double size = std::sqrt(v.head(n).cwiseAbs2().dot(weight));
    if (!std::isfinite(size) || size == 0) return {};
    v /= size;
    // v^T W v = 1 and K v = W v_old/size: the Rayleigh quotient is v^T W v_old/size.
    stiffness = v.head(n).dot(load.head(n)) / size;
    load.head(n) = weight.cwiseProduct(v.head(n));
    if (iteration > 2 && std::abs(stiffness - before) <= settled * std::abs(stiffness)) break;
    before = stiffness;
  }
  Mode mode;
  mode.shape = v.head(n);
  mode.stiffness = stiffness;
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    const double size = std::sqrt(weight[i]) * std::abs(mode.shape[i]);
    if (size <= largest) continue;
    largest = size;
    mode.largest = i;
  }
  mode.shape /= largest;
  // Forces are used if they are sufficient: moments about the axes of nodes rotate with them.
  mode.force = weight.cwiseProduct(mode.shape);
  double reached = 0;
  for (int i = 0; i < n; ++i)
    if (system_.kind(i) != Kind::rotation) reached = std::max(reached, std::sqrt(weight[i]) * std::abs(mode.shape[i]));
  constexpr double enough = 1e-3;
  if (reached > enough)
    for (int i = 0; i < n; ++i)
      if (system_.kind(i) == Kind::rotation) mode.force[i] = 0;
  return mode;
}

std::string Stability::describe(const Mode& mode) const {
  return mode.largest < 0 ? "nothing" : system_.unknown_name(mode.largest);
}

}  // namespace bielle::mechanism
