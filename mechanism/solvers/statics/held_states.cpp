#include "mechanism/solvers/statics/held_states.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/solvers/newton/newton_matrix.hpp"
#include "mechanism/solvers/start/begin_first_order.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {
namespace {

constexpr double negligible_answer = 1e-9;  // negligible size of an entry of S, relative to its terms

/// Returns a small inertia, so that the responses can be computed even if only the controllers hold a part.
double some_inertia(const System& system, const Environment& environment, const State& state, NewtonMatrix& linear) {
  const auto largest = [&](const TangentWeights& weights) {
    linear.assemble(state, environment, weights, nullptr);
    double most = 0;
    for (int i = 0; i < system.dofs(); ++i) most = std::max(most, std::abs(linear.diagonal(i)));
    return most;
  };
  const double stiffness = largest({1, 0, 0, 0, 1, true}), mass = largest({0, 0, 1, 0, 1, true});
  return mass > 0 ? (stiffness > 0 ? stiffness : 1.0) / mass : 0;
}

/// The matrix S and the sizes of its terms; no value if the equations of the other unknowns are singular.
struct Answers {
  MatrixX S, terms;
};
std::optional<Answers> calc_answers(const System& system, const Environment& environment, State state) {
  const std::vector<int>& some = system.holdable();
  const auto n = static_cast<Eigen::Index>(some.size());
  const int first = system.dofs();
  std::fill(state.held.begin(), state.held.end(), char{0});
  std::vector<double> values;
  system.tangent(state, environment, TangentWeights{1, 0, 0, 0, 1, true}, nullptr, values);
  const std::shared_ptr<const TangentPattern> pattern = system.shared_pattern();
  for (const int k : some) state.held[static_cast<std::size_t>(k)] = 1;
  NewtonMatrix linear(system);
  const double inertia = some_inertia(system, environment, state, linear);
  if (!linear.try_factor(state, environment, TangentWeights{1, 0, inertia, 0, 1, true}, nullptr)) return std::nullopt;
  std::vector<Eigen::Index> row_of(static_cast<std::size_t>(system.first_orders()), -1);
  for (Eigen::Index i = 0; i < n; ++i) row_of[static_cast<std::size_t>(some[static_cast<std::size_t>(i)])] = i;
  Answers answers{MatrixX::Zero(n, n), MatrixX::Zero(n, n)};
  VectorX r(system.size()), answer(system.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    r.setZero();
    r[first + some[static_cast<std::size_t>(j)]] = -1;
    linear.solve(r, answer);
    pattern->whole.for_each([&](int place, int row, int column) {
      if (row < first || row >= first + system.first_orders()) return;
      const Eigen::Index i = row_of[static_cast<std::size_t>(row - first)];
      if (i < 0) return;
      const double term = values[static_cast<std::size_t>(place)] * answer[column];
      answers.S(i, j) += term;
      answers.terms(i, j) += std::abs(term);
    });
  }
  return answers;
}

/// Returns the chosen rows and columns of a matrix, scaled to a size of one.
MatrixX scaled_part(const MatrixX& S, const std::vector<Eigen::Index>& chosen) {
  MatrixX part(static_cast<Eigen::Index>(chosen.size()), static_cast<Eigen::Index>(chosen.size()));
  for (Eigen::Index i = 0; i < part.rows(); ++i)
    for (Eigen::Index j = 0; j < part.cols(); ++j)
      part(i, j) = S(chosen[static_cast<std::size_t>(i)], chosen[static_cast<std::size_t>(j)]);
  for (Eigen::Index i = 0; i < part.rows(); ++i)
    if (const double size = part.row(i).cwiseAbs().maxCoeff(); size > 0) part.row(i) /= size;
  for (Eigen::Index j = 0; j < part.cols(); ++j)
    if (const double size = part.col(j).cwiseAbs().maxCoeff(); size > 0) part.col(j) /= size;
  return part;
}

/// Returns the numbers, among the unknowns that may be held, of those that are determined by zero rates.
std::vector<Eigen::Index> find_determined(const Answers& answers) {
  std::vector<Eigen::Index> left;
  for (Eigen::Index k = 0; k < answers.S.rows(); ++k) left.push_back(k);
  const auto is_something = [&](Eigen::Index i, Eigen::Index j) {
    return std::abs(answers.S(i, j)) > negligible_answer * answers.terms(i, j);
  };
  const auto is_empty = [&](Eigen::Index k) {
    const auto by = [&](const auto& entry) { return std::none_of(left.begin(), left.end(), entry); };
    return by([&](Eigen::Index j) { return is_something(k, j); }) ||
           by([&](Eigen::Index i) { return is_something(i, k); });
  };
  while (true) {
    const auto found = std::find_if(left.begin(), left.end(), is_empty);
    if (found == left.end()) break;
    left.erase(found);
  }
  if (left.empty() || regular_inverse(scaled_part(answers.S, left))) return left;
  // An unknown that depends on others is found by leaving out one unknown at a time.
  for (std::size_t k = left.size(); k-- > 0;) {
    std::vector<Eigen::Index> fewer = left;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    if (!fewer.empty() && regular_inverse(scaled_part(answers.S, fewer))) return fewer;
  }
  return {};
}

}  // namespace

void begin_states(const System& system, const Environment& environment, State& state) {
  state.held.clear();
  if (const std::vector<int>& some = system.holdable(); !some.empty()) {
    state.held.assign(static_cast<std::size_t>(system.first_orders()), 0);
    // If the responses cannot be computed, the states are not the reason for a missing equilibrium.
    if (const std::optional<Answers> answers = calc_answers(system, environment, state)) {
      for (const int k : some) state.held[static_cast<std::size_t>(k)] = 1;
      for (const Eigen::Index k : find_determined(*answers))
        state.held[static_cast<std::size_t>(some[static_cast<std::size_t>(k)])] = 0;
    }
  }
  begin_first_order(system, environment, state);
}

std::vector<std::string> held_names(const System& system, const State& state) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < state.held.size(); ++k)
    if (state.held[k]) names.push_back(system.unknown_name(system.dofs() + static_cast<int>(k)));
  return names;
}

std::string describe_held(const std::vector<std::string>& names) {
  return fmt::format("equilibrium does not determine {}: {}", fmt::join(names, ", "),
                     names.size() == 1 ? "it stays as it was" : "they stay as they were");
}

}  // namespace bielle::mechanism
