#include "mechanism/solvers/start/start_rates.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "mechanism/math/rank.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {
namespace {

/// A prescribed rate, w . v + c = target.
struct RateRow {
  const CoordinateCondition* condition;
  VectorX w;  ///< (dofs)
};

}  // namespace

std::vector<bool> dependent_rows(const System& system, const Environment& environment, const State& state,
                                 const std::vector<VectorX>& rows) {
  std::vector<double> values;
  TangentWeights of_constraints{0, 0, 0, 0, 1, true};
  system.tangent(state, environment, of_constraints, nullptr, values);
  const int first = system.size() - system.multipliers(), count = system.multipliers();
  const double arm = system.multipliers() > 0 ? redundancy_arm(system, environment, state) : 1;
  std::vector<Eigen::Triplet<double>> entries;
  const auto scaled = [&](int dof, double value) {
    return value * (system.kind(dof) == Kind::translation ? arm : 1.0);  // translations in units of the arm
  };
  VectorX squares = VectorX::Zero(count + static_cast<Eigen::Index>(rows.size()));
  system.pattern().for_each([&](int place, int row, int column) {
    const double value = values[static_cast<std::size_t>(place)];
    if (row < system.dofs() && column >= first && value != 0) {
      entries.emplace_back(row, column - first, scaled(row, value));
      squares[column - first] += scaled(row, value) * scaled(row, value);
    }
  });
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (int i = 0; i < system.dofs(); ++i)
      if (rows[k][i] != 0) {
        const int column = count + static_cast<int>(k);
        entries.emplace_back(i, column, scaled(i, rows[k][i]));
        squares[column] += scaled(i, rows[k][i]) * scaled(i, rows[k][i]);
      }
  for (Eigen::Triplet<double>& each : entries)
    each = {each.row(), each.col(), each.value() / std::sqrt(squares[each.col()])};
  Eigen::SparseMatrix<double> all(system.dofs(), squares.size());
  all.setFromTriplets(entries.begin(), entries.end());
  constexpr double rounding = 1e-9;
  std::vector<bool> dependent(rows.size(), false);
  for (const int column : dependent_columns(all, rounding))
    if (column >= count) dependent[static_cast<std::size_t>(column - count)] = true;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (squares[count + static_cast<Eigen::Index>(k)] == 0) dependent[k] = true;  // both nodes are held
  return dependent;
}

void set_start_rates(const System& system, const Environment& environment, State& state,
                     const StartConditions& conditions, KktMatrix& saddle, StartReport& report) {
  std::vector<RateRow> rows;
  for (const CoordinateCondition& each : conditions.coordinates) {
    if (!each.rate) continue;
    RateRow row{&each, VectorX::Zero(system.dofs())};
    for (const auto& [dof, value] : coordinate_row(system, environment, state, each.member, each.coordinate).by_rate)
      row.w[dof] += value;
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return;
  if (!saddle.serves()) saddle.factor(environment, state);
  std::vector<VectorX> gradients;
  for (const RateRow& row : rows) gradients.push_back(row.w);
  const std::vector<bool> dependent = dependent_rows(system, environment, state, gradients);
  const auto missing = [&](const RateRow& row) {
    return *row.condition->rate -
           coordinate_row(system, environment, state, row.condition->member, row.condition->coordinate).rate;
  };
  std::vector<const RateRow*> free;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!dependent[k]) free.push_back(&rows[k]);
  const auto count = static_cast<Eigen::Index>(free.size());
  MatrixX Z(system.dofs(), count), W(system.dofs(), count);
  VectorX lacking(count), r = VectorX::Zero(system.size()), step(system.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const RateRow& row = *free[static_cast<std::size_t>(k)];
    W.col(k) = row.w;
    lacking[k] = missing(row);
    r.head(system.dofs()) = -row.w;
    saddle.solve(r, step);
    Z.col(k) = step.head(system.dofs());
  }
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  if (count > 0) {
    MatrixX S(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index j = 0; j < count; ++j) S(i, j) = W.col(i).dot(Z.col(j));
    const VectorX factors = solve_symmetric(MatrixX(0.5 * (S + S.transpose())), lacking);
    for (Eigen::Index k = 0; k < count; ++k) {
      const VectorX change = factors[k] * Z.col(k);
      report.note_change(system, v, change);
      v += change;
    }
    system.set_rates(state, v, a);
  }
  constexpr double agreement = 1e-8;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const CoordinateCondition& condition = *rows[k].condition;
    const StartCoordinate coordinate = start_coordinate(system, condition);
    const std::string name = coordinate_name(system, condition.member, coordinate);
    const double lack = missing(rows[k]), size = std::abs(*condition.rate) + rows[k].w.cwiseAbs().dot(v.cwiseAbs());
    if (std::abs(lack) > agreement * size)
      throw ComputationError(
          fmt::format("the start rate {:.6g} {} of {} contradicts the joints, drives and start rates before it, which "
                      "make it {:.6g} {}: "
                      "leave one of them out, or make them agree",
                      *condition.rate, coordinate.rate_units, name, *condition.rate - lack, coordinate.rate_units));
    if (dependent[k]) report.following.push_back(name);
  }
}

}  // namespace bielle::mechanism
