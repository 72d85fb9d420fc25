#include "mechanism/solvers/statics/stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/SparseCholesky>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

const TangentWeights stiffness_alone{1, 0, 0, 0, 1, true};
constexpr double give = 1e-4;  // of constraints, see the head of stability.hpp

}  // namespace

std::optional<int> Stability::count(const State& state, const Environment& environment) {
  constexpr double asymmetry = 1e-6, of_size = 1e-7;  // relative to an entry, and to the stiffness
  if (system_.dofs() == 0) return 0;
  linear_.assemble(state, environment, stiffness_alone, nullptr, held());
  const std::vector<double>& values = linear_.values();
  const SparsePattern& pattern = system_.pattern();
  const int dofs = system_.dofs(), first = system_.size() - system_.multipliers();
  const VectorX scale = row_scales();
  std::vector<Eigen::Triplet<double>> lower;
  lower.reserve(values.size());
  bool known = true;
  pattern.for_each([&](int place, int row, int column) {
    const double value = values[static_cast<std::size_t>(place)];
    if (!known || value == 0) return;
    const bool row_state = row >= dofs && row < first, column_state = column >= dofs && column < first;
    if (row_state) return;  // what first-order unknowns do is no stiffness,
    if (column_state) {     // unless forces depend on them
      known = false;
      return;
    }
    const int other = pattern.find(column, row);
    if (row < column && other >= 0) return;  // seen from the other side
    const double transposed = other >= 0 ? values[static_cast<std::size_t>(other)] : 0;
    const double size = row >= first || column >= first ? 1 : linear_.scale();
    if (std::abs(value - transposed) > asymmetry * std::max(std::abs(value), std::abs(transposed)) + of_size * size) {
      known = false;
      return;
    }
    lower.emplace_back(std::max(row, column), std::min(row, column),
                       scale[row] * scale[column] * 0.5 * (value + transposed));
  });
  if (!known) return {};
  for (int i = dofs; i < first; ++i) lower.emplace_back(i, i, 1);
  int constraints = 0;
  for (int i = first; i < system_.size(); ++i) {
    const int place = pattern.find(i, i);
    if (place >= 0 && values[static_cast<std::size_t>(place)] > 0) continue;  // out of the equations
    lower.emplace_back(i, i, -give);
    ++constraints;
  }
  Eigen::SparseMatrix<double> A(system_.size(), system_.size());
  A.setFromTriplets(lower.begin(), lower.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors(A);
  if (factors.info() != Eigen::Success) return {};
  const auto pivots = factors.vectorD();
  return static_cast<int>((pivots.array() < 0).count()) - constraints;
}

/// 1 for unknowns; of each constraint the root of the stiffness that it meets: the largest K_jj/B_ij^2 along its row,
/// in which no unit is left, or of what has no stiffness itself (free bodies) that of the whole.
VectorX Stability::row_scales() const {
  const std::vector<double>& values = linear_.values();
  const SparsePattern& pattern = system_.pattern();
  const int dofs = system_.dofs(), first = system_.size() - system_.multipliers();
  VectorX diagonal(dofs), largest = VectorX::Zero(system_.size()), scale = VectorX::Ones(system_.size());
  for (int i = 0; i < dofs; ++i) diagonal[i] = std::abs(linear_.diagonal(i));
  // Stiffness per kind, for rows that meet none.
  std::array<double, kind_count> sum{}, count{};
  for (int i = 0; i < dofs; ++i) {
    sum[static_cast<std::size_t>(system_.kind(i))] += diagonal[i];
    count[static_cast<std::size_t>(system_.kind(i))] += 1;
  }
  const auto usual = [&](int dof) {
    const auto kind = static_cast<std::size_t>(system_.kind(dof));
    return count[kind] > 0 && sum[kind] > 0 ? sum[kind] / count[kind] : linear_.scale();
  };
  const auto each = [&](const auto& act) {
    pattern.for_each([&](int place, int row, int column) {
      const double b = std::abs(values[static_cast<std::size_t>(place)]);
      if (row >= first && column < dofs && b > 0) act(row, column, b);
    });
  };
  each([&](int row, int, double b) { largest[row] = std::max(largest[row], b); });
  VectorX met = VectorX::Zero(system_.size()), fallback = met;
  constexpr double counts = 0.1;  // share of the row's largest entry
  each([&](int row, int column, double b) {
    if (b < counts * largest[row]) return;
    met[row] = std::max(met[row], diagonal[column] / (b * b));
    fallback[row] = std::max(fallback[row], usual(column) / (b * b));
  });
  for (int i = first; i < system_.size(); ++i) {
    const double stiffness = met[i] > 0 ? met[i] : fallback[i];
    if (stiffness > 0) scale[i] = std::sqrt(stiffness);
  }
  return scale;
}

std::optional<Stability::Mode> Stability::softest(const State& state, const Environment& environment) {
  constexpr int most = 60;
  constexpr double settled = 1e-8;
  if (!linear_.try_factor(state, environment, stiffness_alone, nullptr, held())) return {};
  const double length = model_extent(state) > 0 ? model_extent(state) : 1;
  const int n = system_.dofs();
  VectorX weight(n);  // what makes turns and displacements comparable
  for (int i = 0; i < n; ++i) weight[i] = system_.kind(i) == Kind::translation ? 1 / (length * length) : 1;
  VectorX v = VectorX::Zero(system_.size()), load = VectorX::Zero(system_.size());
  // Something along everything: a symmetric start would miss what is antisymmetric.
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
  // By forces where they reach it: moments about the axes of nodes turn with them.
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
