#include "mechanism/solvers/start/idle_rotations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr double rounding = 1e-12;
constexpr double closed_to = 1e-9;  // accuracy of closed loops, whose gaps cause such moments

/// A node with a basis of the motions that move no mass (its unknowns x directions).
struct Candidate {
  int node, begin, count;
  Eigen::MatrixXd motions;
};

/// Returns, for each candidate, the rows of its node (unknowns of the node, columns that they have entries in). It
/// takes one pass over the matrix.
std::vector<Eigen::MatrixXd> rows_of(const std::vector<Candidate>& candidates, const SparsePattern& pattern,
                                     const std::vector<double>& values) {
  struct Rows {
    std::vector<Eigen::VectorXd> columns;
    int last = -1;
  };
  std::vector<Rows> found(candidates.size());
  std::vector<int> owner(static_cast<std::size_t>(pattern.size()), -1);
  for (std::size_t k = 0; k < candidates.size(); ++k)
    std::fill_n(owner.begin() + candidates[k].begin, candidates[k].count, static_cast<int>(k));
  pattern.for_each([&](int place, int row, int column) {
    const int k = owner[static_cast<std::size_t>(row)];
    if (k < 0) return;
    const Candidate& candidate = candidates[static_cast<std::size_t>(k)];
    Rows& rows = found[static_cast<std::size_t>(k)];
    if (column != rows.last) rows.columns.emplace_back(Eigen::VectorXd::Zero(candidate.count));
    rows.last = column;
    rows.columns.back()[row - candidate.begin] = values[static_cast<std::size_t>(place)];
  });
  std::vector<Eigen::MatrixXd> all;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const auto& columns = found[k].columns;
    all.emplace_back(candidates[k].count, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c) all.back().col(static_cast<Eigen::Index>(c)) = columns[c];
  }
  return all;
}

/// Returns the motions of a node without mass, from its block of the mass matrix.
Eigen::MatrixXd massless(const SparsePattern& pattern, const std::vector<double>& mass, int begin, int count) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(count, count);
  for (int row = 0; row < count; ++row)
    for (int column = 0; column < count; ++column)
      if (const int place = pattern.find(begin + row, begin + column); place >= 0)
        M(row, column) = mass[static_cast<std::size_t>(place)];
  const Eigen::VectorXd scale = M.diagonal().unaryExpr([](double m) { return m > 0 ? 1 / std::sqrt(m) : 1.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * M * scale.asDiagonal());
  Eigen::Index without = 0;
  while (without < count && eigen.eigenvalues()[without] <= rounding) ++without;
  return scale.asDiagonal() * eigen.eigenvectors().leftCols(without);
}

/// Returns the largest action that rows could have on a motion. Translations and rotations have their own units.
double largest_action(const Eigen::VectorXd& motion, const Eigen::MatrixXd& rows) {
  const Eigen::Index others = motion.size() - 3;
  const auto largest = [&](Eigen::Index begin, Eigen::Index count) {
    return count == 0 || rows.cols() == 0 ? 0.0
                                          : motion.segment(begin, count).cwiseAbs().maxCoeff() *
                                                rows.middleRows(begin, count).cwiseAbs().maxCoeff();
  };
  return largest(0, others) + largest(others, 3);
}

/// Keeps only the motions on which the rows of a node do not act.
void reduce(Candidate& candidate, const Eigen::MatrixXd& rows) {
  const Eigen::MatrixXd acting = candidate.motions.transpose() * rows;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(acting * acting.transpose());
  const Eigen::MatrixXd turned = candidate.motions * eigen.eigenvectors();
  // The eigenvalues are squares, in which small actions are only rounding. Each direction is therefore tested by its
  // products.
  std::vector<Eigen::Index> left;
  for (Eigen::Index k = 0; k < turned.cols(); ++k) {
    const double size = largest_action(turned.col(k), rows);
    if ((turned.col(k).transpose() * rows).cwiseAbs().maxCoeff() <= closed_to * size) left.push_back(k);
  }
  candidate.motions = Eigen::MatrixXd(turned(Eigen::all, left));
}

/// Returns the state with its loops closed, if this is possible.
State closed(const System& system, const Environment& environment, State state) {
  StartReport report;
  try {
    assemble_positions(system, environment, state, report);
  } catch (const ComputationError&) {  // the start of the analysis reports the loop
  }
  return state;
}

/// Returns a nearby position with other rates, which are the same in each run.
State moved(const System& system, const Environment& environment, const State& start) {
  constexpr double angle = 0.1;
  const double distance = 0.1 * model_length(start);
  VectorX dq(system.dofs()), v(system.dofs());
  for (int k = 0; k < system.dofs(); ++k) {
    dq[k] = angle * std::sin(1.0 + 1.7 * k) * (system.kind(k) == Kind::translation ? distance : 1);
    v[k] = std::cos(2.0 + 2.3 * k);
  }
  State state = start;
  system.displace(state, start, dq);
  state = closed(system, environment, std::move(state));
  system.set_rates(state, v, v);
  return state;
}

/// Returns whether a force of the residual acts along a motion. The other forces on the node determine the size of
/// rounding errors.
bool is_pushed(const Candidate& candidate, const VectorX& residual) {
  const auto own = residual.segment(candidate.begin, candidate.count);
  const double size = candidate.motions.cwiseAbs().maxCoeff() * own.cwiseAbs().maxCoeff();
  return (candidate.motions.transpose() * own).cwiseAbs().maxCoeff() > rounding * size;
}

}  // namespace

std::vector<IdleRotations> idle_rotations(const System& system, const Environment& environment,
                                          const std::vector<int>& nodes) {
  const State drawn = system.start(0);
  std::vector<double> values;
  system.tangent(drawn, environment, {0, 0, 1, 0, 0}, nullptr, values);
  std::vector<Candidate> candidates;
  for (const int node : nodes) {
    const NodeFreedom& freedom = system.kinematics().freedom(node);
    if (freedom.rotations < 3) continue;
    Candidate candidate{node, freedom.begin, freedom.count,
                        massless(system.pattern(), values, freedom.begin, freedom.count)};
    if (candidate.motions.cols() > 0) candidates.push_back(std::move(candidate));
  }
  if (candidates.empty()) return {};
  const State start = closed(system, environment, drawn);
  for (State state : {start, moved(system, environment, start)}) {
    system.tangent(state, environment, {1, 1, 1, 1, 1}, nullptr, values);
    const std::vector<Eigen::MatrixXd> rows = rows_of(candidates, system.pattern(), values);
    for (std::size_t k = 0; k < candidates.size(); ++k)
      if (candidates[k].motions.cols() > 0) reduce(candidates[k], rows[k]);
    for (const double time : {0.0, 0.37, 1.91, 17.3}) {
      state.time = time;
      VectorX residual = VectorX::Zero(system.size());
      system.residual(state, environment, residual);
      std::erase_if(candidates, [&](const Candidate& c) { return c.motions.cols() == 0 || is_pushed(c, residual); });
    }
  }
  std::vector<IdleRotations> found;
  for (const Candidate& candidate : candidates) {
    IdleRotations idle{candidate.node, {}, candidate.motions.cols() == 3};
    for (Eigen::Index k = 0; k < candidate.motions.cols(); ++k) {
      const auto motion = candidate.motions.col(k);
      if (candidate.count > 3 && motion.head(candidate.count - 3).cwiseAbs().maxCoeff() > rounding * motion.norm())
        idle.all = false;
      idle.axes.emplace_back(motion.tail<3>().normalized());
    }
    found.push_back(std::move(idle));
  }
  return found;
}

}  // namespace bielle::mechanism
