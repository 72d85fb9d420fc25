#include "mechanism/solvers/linearised/steadiness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"

namespace bielle::mechanism {
namespace {

/// Returns an arbitrary state, the same in every run.
VectorX some_state(Eigen::Index size, std::uint64_t seed) {
  VectorX x(size);
  for (double& value : x) {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    value = static_cast<double>(static_cast<std::int64_t>(seed)) * 0x1p-63;
  }
  return x;
}

/// Carries increments, or rates, of the dofs along with the axes from one instant to another.
void carry(const System& system, const State& from, const State& to, ModeAxes axes, Eigen::Ref<VectorX> x) {
  for (std::size_t k = 0; k < from.nodes.size(); ++k) {
    const NodeFreedom& freedom = system.kinematics().freedom(static_cast<int>(k));
    if (freedom.count == 0) continue;
    const NodeState &a = from.nodes[k], &b = to.nodes[k];
    const int translations = freedom.count - freedom.rotations;
    if (axes == ModeAxes::inertial) {
      if (freedom.rotations == 3)
        x.segment<3>(freedom.begin + translations) =
            (b.R.transpose() * a.R * x.segment<3>(freedom.begin + translations)).eval();
      continue;
    }
    const MatrixX G = freedom.G.topLeftCorner(3, translations);
    const MatrixX turned = b.R * a.R.transpose() * G;
    const MatrixX kept = G.transpose() * turned;
    if ((turned - G * kept).norm() < 1e-12)
      x.segment(freedom.begin, translations) = (kept * x.segment(freedom.begin, translations)).eval();
  }
}

constexpr double steadily = 1e-3;  // change per radian

struct Rates {
  double velocity = 0, acceleration = 0;  ///< [1/s]
};

Rates rates_of(const State& state) {
  Rates rates;
  const double length = model_length(state);
  for (const NodeState& node : state.nodes) {
    rates.velocity = std::max({rates.velocity, node.Omega.norm(), node.v.norm() / length});
    rates.acceleration =
        std::max({rates.acceleration, std::sqrt(node.Omegadot.norm()), std::sqrt(node.a.norm() / length)});
  }
  return rates;
}

State moved_on(const System& system, const Environment& environment, const State& state, double h) {
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  State later = state;
  later.time = state.time + h;
  later.first_order += h * state.first_order_rate;
  system.displace(later, state, h * v + 0.5 * h * h * a);
  system.set_rates(later, v + h * a, a);
  make_accelerations_consistent(system, environment, later);
  return later;
}

double change(const System& system, const Environment& environment, const State& state, const State& later, double rate,
              ModeAxes axes) {
  const LinearisedEquations now = linearised_equations(system, environment, state, axes),
                            then = linearised_equations(system, environment, later, axes);
  const double h = later.time - state.time;
  constexpr int tries = 4;
  for (int k = 0; k < tries; ++k, rate *= 1.37) {
    const ShiftedOperator T(now, rate), T_later(then, rate);
    if (!T.regular() || !T_later.regular()) continue;
    double most = 0;
    constexpr std::uint64_t seeds[] = {1, 2};
    for (const std::uint64_t seed : seeds) {
      VectorX x = T.apply(T.apply(T.apply(some_state(now.states(), seed))));
      const VectorX answer = T.apply(x);
      const auto carried = [&](const VectorX& scaled) {
        VectorX physical = T.scale().cwiseProduct(scaled);
        carry(system, state, later, axes, physical.head(now.dofs));
        carry(system, state, later, axes, physical.tail(now.dofs));
        return VectorX(physical.cwiseQuotient(T_later.scale()));
      };
      const VectorX expected = carried(answer);
      most = std::max(most, (T_later.apply(carried(x)) - expected).norm() / expected.norm());
    }
    return most / h;
  }
  return 0;  // the search for modes will report this error
}

/// Returns the increments of the dofs by a rotation vector about an axis through a point.
VectorX increments_of_turn(const System& system, const State& state, const Vector3& turn, const Vector3& through) {
  const Matrix3 R = exp_so3(turn);
  VectorX dq = VectorX::Zero(system.dofs());
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    const NodeFreedom& freedom = system.kinematics().freedom(static_cast<int>(k));
    const NodeState& node = state.nodes[k];
    const int translations = freedom.count - freedom.rotations;
    const Vector3 arm = node.x - through;
    dq.segment(freedom.begin, translations) = freedom.G.topLeftCorner(3, translations).transpose() * (R * arm - arm);
    if (freedom.rotations == 3) dq.segment<3>(freedom.begin + translations) = node.R.transpose() * turn;
  }
  return dq;
}

/// Returns the largest force at a node, relative to the acting forces, by accelerations that vary by `change`.
std::optional<StandingForce> force_of(const System& system, const Environment& environment, const State& state,
                                      const VectorX& change) {
  const LinearisedEquations equations = linearised_equations(system, environment, state, ModeAxes::inertial);
  const int n = system.dofs();
  const VectorX force = equations.M.topLeftCorner(n, n) * change;
  VectorX extents = VectorX::Ones(equations.K.cols());
  double farthest = 0;
  for (const NodeState& node : state.nodes) farthest = std::max(farthest, node.x.norm());
  for (int i = 0; i < n; ++i)
    if (system.kind(i) == Kind::translation) extents[i] = farthest;
  constexpr double eps = 64 * 0x1p-52;  // stiff parts turn rounding of positions into forces
  const VectorX rounding = eps * (equations.K.cwiseAbs() * extents);
  VectorX r(system.size());
  ResidualScale scale;
  system.residual(state, environment, r, &scale);
  std::optional<StandingForce> found;
  double most = 1e-8;  // relative to the largest acting force
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    const NodeFreedom& freedom = system.kinematics().freedom(static_cast<int>(k));
    const int translations = freedom.count - freedom.rotations;
    for (const bool moment : {false, true}) {
      const int begin = freedom.begin + (moment ? translations : 0), count = moment ? freedom.rotations : translations;
      if (count == 0) continue;
      const double size = force.segment(begin, count).norm(), acting = scale[system.kind(begin)];
      if (size <= rounding.segment(begin, count).norm() || size <= most * acting) continue;
      most = size / acting;
      found = StandingForce{size / std::numbers::sqrt2, static_cast<int>(k), moment};
    }
  }
  return found;
}

}  // namespace

ModeAxes Steadiness::axes() const {
  constexpr double clearly = 0.3, exactly = 1e-2, rounding = 1e-8;
  const bool worse = inertial > steadily * rate && turning < clearly * inertial;
  const bool not_exact = inertial > rounding * rate && turning < exactly * inertial;
  return worse || not_exact ? ModeAxes::turning : ModeAxes::inertial;
}

bool Steadiness::steady() const { return least() <= steadily * rate; }
bool Steadiness::steady_in(ModeAxes axes) const { return change(axes) <= steadily * rate; }
double Steadiness::drift(ModeAxes axes) const { return steady_in(axes) ? change(axes) / rate : 0; }

std::optional<Steadiness> find_steadiness(const System& system, const Environment& environment, const State& state) {
  Steadiness steadiness;
  const Rates rates = rates_of(state);
  constexpr double negligible = 1e-7;  // its square is below rounding
  if (rates.velocity <= negligible * slowest_rate(linearised_equations(system, environment, state, ModeAxes::inertial)))
    return std::nullopt;
  steadiness.rate = std::max(rates.velocity, rates.acceleration);
  constexpr double part = 1e-5;  // fraction of the time for a radian; differences keep half of the digits
  const State later = moved_on(system, environment, state, part / steadiness.rate);
  steadiness.inertial = change(system, environment, state, later, steadiness.rate, ModeAxes::inertial);
  steadiness.turning = change(system, environment, state, later, steadiness.rate, ModeAxes::turning);
  return steadiness;
}

std::optional<StandingForce> standing_force(const System& system, const Environment& environment, const State& state,
                                            const Vector3& omega, const Vector3& through) {
  const double angle = 0.5 * std::numbers::pi;
  const Vector3 turn = angle * omega.normalized();
  const Matrix3 R = exp_so3(turn);
  State before = state;
  make_accelerations_consistent(system, environment, before);
  State turned = before;
  turned.time += angle / omega.norm();  // prescribed motions depend on it
  VectorX v(system.dofs()), expected(system.dofs()), a(system.dofs());
  system.displace(turned, before, increments_of_turn(system, before, turn, through));
  for (std::size_t k = 0; k < before.nodes.size(); ++k) {
    turned.nodes[k].v = R * before.nodes[k].v;
    turned.nodes[k].a = R * before.nodes[k].a;
  }
  system.get_rates(turned, v, expected);
  system.set_rates(turned, v, expected);
  make_accelerations_consistent(system, environment, turned);
  system.get_rates(turned, v, a);
  return force_of(system, environment, turned, VectorX(a - expected));
}

double unbalance(const System& system, const Environment& environment, const State& state, int& equation) {
  // Forces within one component may balance each other. Forces that move nothing are not an unbalance.
  constexpr double negligible = 1e-9;  // relative to the mechanism's size: distance from equilibrium, or motion in 1 s
  const double softest = slowest_rate(linearised_equations(system, environment, state, ModeAxes::inertial));
  if (std::pow(rates_of(state).acceleration, 2) <= negligible * std::max(1.0, softest * softest)) return 0;
  State still = state;
  system.set_rates(still, VectorX::Zero(system.dofs()), VectorX::Zero(system.dofs()));
  VectorX r(system.size());
  ResidualScale scale;
  system.residual(still, environment, r, &scale);
  double most = 0;
  for (int i = 0; i < system.dofs(); ++i) {
    const double forces = scale[system.kind(i)];
    if (forces == 0 || std::abs(r[i]) <= most * forces) continue;
    most = std::abs(r[i]) / forces;
    equation = i;
  }
  return most;
}

}  // namespace bielle::mechanism
