#include "mechanism/solvers/linearised/azimuth_equations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/linearised/mean_forces.hpp"
#include "mechanism/solvers/linearised/residual_sizes.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/common/error.hpp"
#include "reduce/dense/dense_solves.hpp"

namespace bielle::mechanism {
namespace {

using Sparse = LinearisedEquations::Sparse;
using Entries = std::vector<Eigen::Triplet<double>>;

/// Numbers of a member's rows among the active constraints.
using MemberRows = std::vector<int>;

std::vector<MemberRows> rows_of_members(const System& system, const std::vector<int>& multiplier) {
  std::vector<int> owner(static_cast<std::size_t>(system.multipliers()), -1);
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Slots& slots = system.slots()[m];
    for (int k = 0; k < slots.multipliers; ++k)
      owner[static_cast<std::size_t>(slots.multiplier_begin + k)] = static_cast<int>(m);
  }
  std::vector<MemberRows> rows(system.slots().size());
  for (std::size_t k = 0; k < multiplier.size(); ++k)
    if (const int m = owner[static_cast<std::size_t>(multiplier[k])]; m >= 0)
      rows[static_cast<std::size_t>(m)].push_back(static_cast<int>(k));
  return rows;
}

class TurnedEquations {
 public:
  TurnedEquations(const System& system, const Environment& environment, const State& state, const TurningPart& part)
      : system_(system),
        state_(state),
        part_(part),
        forces_(system, environment, &part),
        turning_(part.turning_unknowns(system)) {}

  Azimuth at(double angle) {
    State turned = state_;
    part_.turn_by(angle, turned);
    Sparse axes = turning_axes(angle);
    VectorX residual(system_.size());
    forces_.residual(turned, residual);
    if (rows_.empty()) {
      LinearisedEquations here =
          linearised_equations(system_, turned, ModeAxes::turning, forces_.matrices(turned), residual);
      rows_ = rows_of_members(system_, here.multiplier);
      first_ = Sparse((here.B * axes).transpose());
      Sparse rows(here.constraints(), here.constraints());
      rows.setIdentity();
      return {std::move(turned), std::move(here), std::move(axes), std::move(rows)};
    }
    // The multipliers of the combined rows are chosen such that the forces stay the same.
    const LinearisedEquations before =
        linearised_equations(system_, turned, ModeAxes::turning, forces_.matrices(turned), residual);
    Sparse rows = combined_rows(Sparse((before.B * axes).transpose()));
    VectorX active(before.constraints());
    for (int k = 0; k < before.constraints(); ++k)
      active[k] = turned.multiplier[before.multiplier[static_cast<std::size_t>(k)]];
    active = (rows.transpose() * active).eval();
    for (int k = 0; k < before.constraints(); ++k)
      turned.multiplier[before.multiplier[static_cast<std::size_t>(k)]] = active[k];
    forces_.residual(turned, residual);
    check_steady(residual, turned, before.K, angle);
    LinearisedEquations here =
        linearised_equations(system_, turned, ModeAxes::turning, forces_.matrices(turned), residual);
    here.M = congruent(axes, here.M);
    here.C = congruent(axes, here.C);
    here.K = congruent(axes, here.K);
    here.B = Sparse(rows * here.B * axes);
    here.S = Sparse(rows * here.S * axes);
    here.F = Sparse(axes.transpose() * here.F * rows.transpose());
    return {std::move(turned), std::move(here), std::move(axes), std::move(rows)};
  }

 private:
  static Sparse congruent(const Sparse& axes, const Sparse& A) { return Sparse(axes.transpose() * A * axes); }

  /// Returns the increments in axes of the node for unit increments in turning axes.
  Sparse turning_axes(double angle) const {
    const Matrix3 turned = exp_so3(Vector3(angle * part_.axis(state_)));
    const auto n = static_cast<Eigen::Index>(turning_.size());
    std::vector<char> done(turning_.size(), 0);
    Entries entries;
    for (std::size_t k = 0; k < state_.nodes.size(); ++k) {
      const auto node = static_cast<int>(k);
      const NodeFreedom& freedom = system_.kinematics().freedom(node);
      const int count = freedom.count - freedom.rotations;
      if (!part_.turns(node) || freedom.count == 0 || count == 0 || system_.kinematics().carry(node)) continue;
      const MatrixX G = freedom.G.topLeftCorner(3, count), block = G.transpose() * turned * G;
      for (int j = 0; j < count; ++j) {
        done[static_cast<std::size_t>(freedom.begin + j)] = 1;
        for (int i = 0; i < count; ++i)
          if (block(i, j) != 0) entries.emplace_back(freedom.begin + i, freedom.begin + j, block(i, j));
      }
    }
    for (int i = 0; i < static_cast<int>(n); ++i)
      if (done[static_cast<std::size_t>(i)] == 0) entries.emplace_back(i, i, 1);
    Sparse axes(n, n);
    axes.setFromTriplets(entries.begin(), entries.end());
    return axes;
  }

  /// Returns the entries of a member's rows in columns of turning unknowns.
  MatrixX turning_entries(const Sparse& transposed, const MemberRows& rows, const std::vector<int>& columns) const {
    MatrixX entries(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j)
        entries(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = transposed.coeff(columns[j], rows[i]);
    return entries;
  }

  std::vector<int> turning_columns(const Sparse& transposed, const MemberRows& rows) const {
    std::vector<int> columns;
    for (const Sparse* each : {&first_, &transposed})
      for (const int row : rows)
        for (Sparse::InnerIterator it(*each, row); it; ++it)
          if (turning_[static_cast<std::size_t>(it.row())] != 0) columns.push_back(static_cast<int>(it.row()));
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
  }

  /// Returns Q with Q B(psi) = B(0) at turning unknowns; the identity for rows without any.
  Sparse combined_rows(const Sparse& transposed) const {
    Entries entries;
    for (const MemberRows& rows : rows_) {
      if (rows.empty()) continue;
      const std::vector<int> columns = turning_columns(transposed, rows);
      const auto size = static_cast<Eigen::Index>(rows.size());
      MatrixX Q = MatrixX::Identity(size, size);
      if (!columns.empty()) {
        const MatrixX at_zero = turning_entries(first_, rows, columns),
                      here = turning_entries(transposed, rows, columns);
        const MatrixX found = least_combination(at_zero, here);
        constexpr double exact = 1e-9;
        if (found.allFinite() && (found * here - at_zero).norm() <= exact * at_zero.norm()) Q = found;
      }
      for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = 0; j < size; ++j)
          if (Q(i, j) != 0)
            entries.emplace_back(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)], Q(i, j));
    }
    Sparse Q(transposed.cols(), transposed.cols());
    Q.setFromTriplets(entries.begin(), entries.end());
    return Q;
  }

  /// Returns A B^T (B B^T)^-1.
  static MatrixX least_combination(const MatrixX& A, const MatrixX& B) {
    const MatrixX square = B * B.transpose();
    MatrixX result(A.rows(), A.rows());
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      result.row(i) = solve_symmetric(square, VectorX(B * A.row(i).transpose())).transpose();
    return result;
  }

  /// @param K  stiffness, whose rounding limits the accuracy of the residual
  void check_steady(const VectorX& residual, const State& turned, const Sparse& K, double angle) const {
    ResidualScale scale;
    VectorX unused(system_.size());
    forces_.residual(turned, unused, &scale);
    constexpr double balanced = 1e-6;  // relative to the largest force: equilibria are found to 1e-9
    const VectorX sizes = residual_sizes(system_, K, scale, model_length(turned), balanced);
    for (int i = 0; i < system_.dofs(); ++i)
      if (std::abs(residual[i]) > balanced * sizes[i])
        throw ComputationError(fmt::format(
            "the rotation is not steady: {} is not the same after a turn by {:.3g} degrees (it changes by "
            "{:.3g} {}): something resists or drives the part at some azimuths only",
            system_.equation_name(i), angle * 180 / std::numbers::pi, residual[i], system_.equation_units(i)));
  }

  const System& system_;
  const State& state_;
  const TurningPart& part_;
  MeanForces forces_;
  std::vector<char> turning_;
  std::vector<MemberRows> rows_;
  Sparse first_;  ///< transposed rows at the first azimuth
};

}  // namespace

std::vector<Azimuth> azimuths_over_turn(const System& system, const Environment& environment, const State& state,
                                        const TurningPart& part, int count) {
  TurnedEquations turned(system, environment, state, part);
  std::vector<Azimuth> azimuths;
  for (int k = 0; k < count; ++k) azimuths.push_back(turned.at(2 * std::numbers::pi * k / count));
  return azimuths;
}

std::vector<LinearisedEquations> equations_over_turn(const System& system, const Environment& environment,
                                                     const State& state, const TurningPart& part, int count) {
  std::vector<LinearisedEquations> equations;
  for (Azimuth& each : azimuths_over_turn(system, environment, state, part, count))
    equations.push_back(std::move(each.equations));
  return equations;
}

}  // namespace bielle::mechanism
