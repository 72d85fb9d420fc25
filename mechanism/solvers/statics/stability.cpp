#include "mechanism/solvers/statics/stability.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/SparseCholesky>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

const TangentWeights stiffness_alone{1, 0, 0, 0, 1, true};

}  // namespace

std::optional<int> Stability::count(const State& state, const Environment& environment) {
  constexpr double give = 1e-4;       // of constraints, see the head of stability.hpp
  constexpr double asymmetry = 1e-9;  // relative to the stiffness
  if (system_.dofs() == 0) return 0;
  linear_.assemble(state, environment, stiffness_alone, nullptr);
  const std::vector<double>& values = linear_.values();
  const SparsePattern& pattern = system_.pattern();
  const int begin = system_.size() - system_.multipliers();
  const double k = linear_.scale();
  std::vector<Eigen::Triplet<double>> lower;
  lower.reserve(values.size());
  bool symmetric = true;
  pattern.for_each([&](int place, int row, int column) {
    const double value = values[static_cast<std::size_t>(place)];
    if (!symmetric || value == 0) return;
    if (row < column && pattern.find(column, row) >= 0) return;  // seen from the other side
    const int other = pattern.find(column, row);
    const double transposed = other >= 0 ? values[static_cast<std::size_t>(other)] : 0;
    // Rows of constraints are of lengths or of ones.
    const double scale = row >= begin || column >= begin ? 1 : k;
    if (std::abs(value - transposed) > asymmetry * std::max(scale, std::abs(value))) {
      symmetric = false;
      return;
    }
    const double weight = (row >= begin ? k : 1) * (column >= begin ? k : 1);
    lower.emplace_back(std::max(row, column), std::min(row, column), weight * 0.5 * (value + transposed));
  });
  if (!symmetric) return {};
  int constraints = 0;
  for (int i = begin; i < system_.size(); ++i) {
    const int place = pattern.find(i, i);
    if (place >= 0 && values[static_cast<std::size_t>(place)] > 0) continue;  // out of the equations
    lower.emplace_back(i, i, -give * k);
    ++constraints;
  }
  Eigen::SparseMatrix<double> A(system_.size(), system_.size());
  A.setFromTriplets(lower.begin(), lower.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors(A);
  if (factors.info() != Eigen::Success) return {};
  const auto pivots = factors.vectorD();
  return static_cast<int>((pivots.array() < 0).count()) - constraints;
}

std::optional<Stability::Mode> Stability::softest(const State& state, const Environment& environment) {
  constexpr int most = 60;
  constexpr double settled = 1e-8;
  if (!linear_.try_factor(state, environment, stiffness_alone, nullptr)) return {};
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
  mode.force = weight.cwiseProduct(mode.shape);
  return mode;
}

std::string Stability::describe(const Mode& mode) const {
  return mode.largest < 0 ? "nothing" : system_.unknown_name(mode.largest);
}

}  // namespace bielle::mechanism
