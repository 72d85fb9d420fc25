#include "mechanism/solvers/start/closing_equations.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanism/math/sparse_factors.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

const TangentWeights closing_weights{1, 0, 0, 1, 1, true};

}  // namespace

ClosingEquations::ClosingEquations(const System& system, const Environment& environment, const State& state,
                                   const StartConditions& conditions, const TakingPart& who)
    : system_(system),
      environment_(environment),
      conditions_(conditions),
      still_(static_cast<std::size_t>(system.dofs()), false),
      half_extent_(0.5 * model_extent(state)),
      drawn_(system.size()),
      elastic_(system.size()) {
  unloaded_.load_factor = 0;
  for (const CoordinateCondition& each : conditions.coordinates) {
    if (!each.value) continue;
    valued_.push_back(&each);
    coordinates_.push_back(start_coordinate(system, each));
  }
  for (const int node : conditions.kept_nodes) {
    const Carry* carry = system.kinematics().carry(node);
    const NodeFreedom& freedom = system.kinematics().freedom(carry ? carry->carrier : node);
    std::fill_n(still_.begin() + freedom.begin, freedom.count, true);
  }
  idle_.assign(static_cast<std::size_t>(system.multipliers()), Idle::active);
  if (state.idle.empty())
    for (const int multiplier : system.set_aside()) idle_[static_cast<std::size_t>(multiplier)] = Idle::redundant;
  else
    idle_ = state.idle;
  choose_rows(who);
  make_pattern(state);
  weigh(state);
  // Initial forces of elastic parts are preserved; forces due to the motion are relaxed.
  system.residual(at_rest(state), unloaded_, drawn_);
}

void ClosingEquations::choose_rows(const TakingPart& who) {
  for (int k = 0; k < system_.multipliers(); ++k) {
    char& idle = idle_[static_cast<std::size_t>(k)];
    if (who.set_aside && idle == Idle::redundant) idle = Idle::active;
    const bool holonomic = system_.constraint_kind(k) == ConstraintKind::holonomic;
    any_nonholonomic_ = any_nonholonomic_ || (!holonomic && idle == Idle::active);
    active_.push_back(idle == Idle::active && (holonomic || who.nonholonomic));
  }
  active_.insert(active_.end(), valued_.size(), true);
}

State ClosingEquations::taken(const State& state) const {
  State result = state;
  result.idle = idle_;
  result.multiplier.setZero();
  result.reaction.resize(0);
  return result;
}

State ClosingEquations::at_rest(const State& state) const {
  State result = taken(state);
  system_.set_rates(result, VectorX::Zero(system_.dofs()), VectorX::Zero(system_.dofs()));
  return result;
}

void ClosingEquations::make_pattern(const State& state) {
  const int size = system_.size(), whole = size + static_cast<int>(valued_.size());
  of_ = system_.shared_pattern();
  factors_.reset();
  condensed_.reset();
  from_system_.clear();
  diagonal_.clear();
  std::vector<std::pair<int, int>> entries;
  entries.reserve(static_cast<std::size_t>(system_.pattern().entry_count() + whole));
  system_.pattern().for_each([&](int, int row, int column) { entries.emplace_back(row, column); });
  for (int k = 0; k < whole; ++k) entries.emplace_back(k, k);
  for (std::size_t k = 0; k < valued_.size(); ++k) {
    const int row = size + static_cast<int>(k);
    for (const auto& [dof, value] :
         coordinate_row(system_, environment_, state, valued_[k]->member, valued_[k]->coordinate).by_position) {
      entries.emplace_back(row, dof);
      entries.emplace_back(dof, row);
    }
  }
  pattern_ = SparsePattern(whole, std::move(entries));
  system_.pattern().for_each([&](int, int row, int column) { from_system_.push_back(pattern_.find(row, column)); });
  for (int k = 0; k < whole; ++k) diagonal_.push_back(pattern_.find(k, k));
  condensed_ = std::make_unique<CondensedPattern>(pattern_, system_.lone_amplitudes());
  factors_ = std::make_unique<CondensedLU>(*condensed_);
}

void ClosingEquations::weigh(const State& state) {
  assemble(state);
  const int first = system_.size() - system_.multipliers();
  const double length = model_length(state);
  VectorX squares = VectorX::Zero(pattern_.size());
  sizes_ = VectorX::Zero(pattern_.size());
  pattern_.for_each([&](int place, int row, int column) {
    if (row < first || column >= system_.dofs()) return;
    const double entry = std::abs(values_[static_cast<std::size_t>(place)]);
    const bool turn = system_.kind(column) == Kind::rotation;
    if (turn || system_.kind(column) == Kind::translation) {
      const double arm = turn ? entry / half_extent_ : entry;
      squares[row] += arm * arm;
    }
    sizes_[row] += entry * (system_.kind(column) == Kind::translation ? length : 1.0);
  });
  const auto rows = pattern_.size() - first;
  sizes_ = (sizes_.tail(rows).array() > 0).select(sizes_.tail(rows), 1.0).eval();
  weights_ = (squares.tail(rows).array() > 0).select(squares.tail(rows).cwiseInverse(), 1.0);
}

State ClosingEquations::shaken(const State& state) const {
  constexpr double angle = 0.05, part = 0.02;
  VectorX dq = VectorX::Zero(system_.dofs());
  for (int i = 0; i < system_.dofs(); ++i) {
    if (still_[static_cast<std::size_t>(i)]) continue;
    const double share = std::sin(1 + 1.7 * i);  // the direction is not aligned with any axis
    if (system_.kind(i) == Kind::rotation) dq[i] = angle * share;
    if (system_.kind(i) == Kind::translation) dq[i] = 2 * part * half_extent_ * share;
  }
  State result = state;
  system_.displace(result, state, dq);
  return result;
}

ClosingEquations::Gaps ClosingEquations::measure(const State& state) const {
  Gaps gaps;
  VectorX r(system_.size());
  system_.residual(taken(state), environment_, r);
  gaps.values = VectorX::Zero(rows());
  gaps.values.head(system_.multipliers()) = r.tail(system_.multipliers());
  for (std::size_t k = 0; k < valued_.size(); ++k) {
    const CoordinateCondition& condition = *valued_[k];
    const CoordinateRow row = coordinate_row(system_, environment_, state, condition.member, condition.coordinate);
    gaps.values[system_.multipliers() + static_cast<Eigen::Index>(k)] =
        coordinate_distance(coordinates_[k], row.value, condition.value.value_or(0));
  }
  for (int k = 0; k < rows(); ++k) {
    double& value = gaps.values[k];
    if (!takes_part(k) || (k < system_.multipliers() && system_.constraint_kind(k) == ConstraintKind::nonholonomic)) {
      value = 0;
      continue;
    }
    gaps.squared += weights_[k] * value * value;
    const double violation = std::abs(value) / sizes_[k];
    if (violation <= gaps.worst || std::isnan(gaps.worst)) continue;
    gaps.worst = violation;
    gaps.worst_row = k;
  }
  return gaps;
}

void ClosingEquations::assemble(const State& state, const VectorX* forces) {
  State still = at_rest(state);
  system_.residual(still, unloaded_, elastic_);
  if (forces)
    for (int k = 0; k < system_.multipliers(); ++k)
      if (takes_part(k)) still.multiplier[k] = (*forces)[k];
  system_.tangent(still, unloaded_, closing_weights, nullptr, tangent_);
  if (of_ != system_.shared_pattern()) make_pattern(state);
  if (bare_) {
    elastic_.head(system_.dofs()) = drawn_.head(system_.dofs());
    system_.pattern().for_each([&](int place, int row, int column) {
      if (row < system_.dofs() && column < system_.dofs()) tangent_[static_cast<std::size_t>(place)] = 0;
    });
  }
  values_.assign(static_cast<std::size_t>(pattern_.entry_count()), 0.0);
  for (std::size_t k = 0; k < tangent_.size(); ++k) values_[static_cast<std::size_t>(from_system_[k])] = tangent_[k];
  for (std::size_t k = 0; k < valued_.size(); ++k) {
    const int row = system_.size() + static_cast<int>(k);
    for (const auto& [dof, value] :
         coordinate_row(system_, environment_, state, valued_[k]->member, valued_[k]->coordinate).by_position) {
      values_[static_cast<std::size_t>(pattern_.find(row, dof))] += value;
      values_[static_cast<std::size_t>(pattern_.find(dof, row))] += value;
    }
  }
  if (forces && metric_.size() > 0) return;  // the metric is that of the bodies
  // Mean stiffness of each kind of dof. A kind without stiffness takes it from the other kind by the mechanism's size.
  std::array<double, kind_count> mean{}, count{};
  for (int i = 0; i < system_.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system_.kind(i));
    mean[kind] += std::abs(values_[static_cast<std::size_t>(diagonal_[static_cast<std::size_t>(i)])]);
    count[kind] += 1;
  }
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (count[kind] > 0) mean[kind] /= count[kind];
  double &translation = mean[static_cast<std::size_t>(Kind::translation)],
         &rotation = mean[static_cast<std::size_t>(Kind::rotation)];
  any_stiffness_ = any_stiffness_ || std::any_of(mean.begin(), mean.end(), [](double each) { return each > 0; });
  const double area = half_extent_ * half_extent_;
  if (translation == 0) translation = rotation > 0 ? rotation / area : 1;
  if (rotation == 0) rotation = translation * area;
  stiffness_ = translation;
  metric_.resize(system_.dofs());
  for (int i = 0; i < system_.dofs(); ++i) {
    const double own = mean[static_cast<std::size_t>(system_.kind(i))];
    metric_[i] = own > 0 ? own : 1.0;
  }
}

bool ClosingEquations::factor(const VectorX& compliance, double floor) {
  work_ = values_;
  const auto at = [&](int unknown) -> double& {
    return work_[static_cast<std::size_t>(diagonal_[static_cast<std::size_t>(unknown)])];
  };
  const int first = system_.size() - system_.multipliers();
  const auto is_out = [&](int unknown) {
    if (unknown < system_.dofs()) return bool(still_[static_cast<std::size_t>(unknown)]);
    return unknown >= first && !takes_part(unknown - first);
  };
  for (int i = 0; i < system_.dofs(); ++i) at(i) += floor * metric_[i];
  for (int k = 0; k < rows(); ++k)
    if (takes_part(k)) at(first + k) = -compliance[k];
  pattern_.for_each([&](int place, int row, int column) {
    if (is_out(row) || is_out(column)) work_[static_cast<std::size_t>(place)] = row == column ? 1 : 0;
  });
  VectorX scale = VectorX::Ones(pattern_.size());
  double size = 0;
  for (int i = 0; i < system_.dofs(); ++i)
    if (system_.kind(i) == Kind::translation) size = std::max(size, metric_[i]);
  scale.tail(rows()).setConstant(size > 0 ? size : stiffness_);
  return factors_->factor(work_, scale, system_.workers()) == FactorStatus::good;
}

void ClosingEquations::solve(const VectorX& phi, VectorX& dq, VectorX& dy, VectorX& mu) const {
  const int first = system_.size() - system_.multipliers();
  VectorX x(pattern_.size());
  x << drawn_.head(first) - elastic_.head(first), -phi;
  for (int i = 0; i < system_.dofs(); ++i)
    if (still_[static_cast<std::size_t>(i)]) x[i] = 0;
  for (int k = 0; k < rows(); ++k)
    if (!takes_part(k)) x[first + k] = 0;
  factors_->solve(x);
  dq = x.head(system_.dofs());
  dy = x.segment(system_.dofs(), system_.first_orders());
  mu = x.tail(rows());
}

VectorX ClosingEquations::forces_on_dofs(const VectorX& f) const {
  const int first = system_.size() - system_.multipliers();
  VectorX forces = VectorX::Zero(system_.dofs());
  pattern_.for_each([&](int place, int row, int column) {
    if (row >= first && column < system_.dofs() && takes_part(row - first))
      forces[column] += values_[static_cast<std::size_t>(place)] * f[row - first];
  });
  return forces;
}

}  // namespace bielle::mechanism
