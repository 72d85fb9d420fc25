#include "mechanism/solvers/statics/equilibrium.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/model/open_contact.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/statics/node_motion.hpp"

namespace bielle::mechanism {
namespace {

constexpr double longest = 0.3;       // step of `relax`: relative to the mechanism's size, or [rad]
constexpr double longest_turn = 2.0;  // step of Newton's method [rad]
constexpr double least_share = 0.1;   // smallest fraction of a step

}  // namespace

Equilibrium::Equilibrium(const LoadRamp& ramp, const NewtonOptions& options, Bordering* further)
    : ramp_(ramp),
      system_(ramp.system()),
      options_(options),
      tangent_(system_),
      convergence_(system_, options),
      reactions_(system_),
      search_(system_),
      further_(further),
      r_(system_.size()),
      delta_(system_.size()) {}

int Equilibrium::find(double factor, State& state, const State* before) {
  return attempt(factor, state, [&] {
    stepped_ = before;
    if (before) before_ = *before;
    return iterate(factor, state, &Equilibrium::step);
  });
}

int Equilibrium::search(double factor, State& state) {
  return attempt(factor, state, [&] { return iterate(factor, state, &Equilibrium::search_step); });
}

int Equilibrium::relax(double factor, State& state) {
  return attempt(factor, state, [&] { return iterate_relaxing(factor, state); });
}

/// Tries to find the equilibrium. If a component cannot be evaluated at a distant iterate (a beam whose ends rotate too
/// far), the attempt fails, not the analysis.
template <class Iterations>
int Equilibrium::attempt(double factor, State& state, const Iterations& iterations) {
  start_ = state;
  environment_ = ramp_.environment(factor);
  int count = attempt_once(state, iterations);
  if (count < 0 && !falls_ && !search_.empty()) {
    state = start_;
    searches_ = true;
    count = attempt_once(state, iterations);
    searches_ = false;
    if (count < 0 && !search_.why().empty()) why_ = search_.why();
  }
  if (count >= 0) return count;
  state = start_;
  why_ += what_is_open(state);
  return -1;
}

template <class Iterations>
int Equilibrium::attempt_once(const State& state, const Iterations& iterations) {
  judged_ = stepped_ = falls_ = false;
  balanced_.resize(0);
  if (further_) further_->begin();
  why_.clear();
  int count = -1;
  try {
    count = iterations();
  } catch (const ComputationError& error) {
    why_ = error.what();
    if (judged_) why_ += fmt::format("; largest residual before: {}", convergence_.worst());
  }
  if (count >= 0 && search_.beyond_bounds(state)) count = -1;
  if (count < 0 && why_.empty())
    why_ = fmt::format("Newton did not converge; largest residual: {}", convergence_.worst());
  return count;
}

/// Describes open contacts, which may be the reason why a part lacks a support.
std::string Equilibrium::what_is_open(const State& state) const {
  std::string text;
  const auto& members = system_.model().members();
  for (std::size_t m = 0; m < members.size(); ++m)
    if (const auto* contact = dynamic_cast<const OpenContact*>(members[m].component.get());
        contact && system_.is_active(state, m))
      if (const std::string open = contact->what_is_open(LocalState(state, system_.slots()[m], environment_));
          !open.empty())
        text += fmt::format("; {} {}", describe(members[m]), open);
  if (!text.empty()) text += " (in statics what is open holds nothing: begin with the parts in contact)";
  return text;
}

void Equilibrium::accept(double factor, State& state) const {
  const Environment loaded = ramp_.environment(factor);  // attempts at other load factors may have followed
  try {
    check_set_aside(system_, loaded, state);
    system_.accept(state, loaded);
  } catch (const ComputationError& error) {
    throw ComputationError(
        fmt::format("statics: the equilibrium at load factor {:.6g} is refused: {}; largest residual: {}", factor,
                    error.what(), convergence_.worst()));
  }
}

/// Stores the last solution as that of the first iteration.
void Equilibrium::note_first() {
  first_response_ = delta_;
  first_sign_ = last_sign_;
}

void Equilibrium::factor_derivative(double factor, const State& state, Eigen::Ref<VectorX> result) const {
  if (follows_)
    ramp_.factor_derivative(state, factor, result);
  else
    ramp_.load_derivative(state, factor, result);
}

VectorX Equilibrium::response(double factor, const State& state, double change) {
  factor_derivative(factor, state, r_);
  r_ *= change;
  tangent_.solve(r_, delta_);
  return delta_;
}

void Equilibrium::respond(double factor, State& state, const State* before, Continuation& point) {
  environment_ = ramp_.environment(factor);
  evaluate(state);
  if (!r_.allFinite()) throw ComputationError("a residual is too large for a number (overflow)");
  environment_.before = before;
  tangent_.factor(state, environment_);
  environment_.before = nullptr;
  solve();
  point.correction = delta_;
  point.rate = response(factor, state, 1);
  State corrected = displaced(system_, state, state.motion_factor, point.correction);
  evaluate(corrected);
  tangent_.solve(r_, delta_);
  point.second = delta_;
}

int Equilibrium::iterate(double factor, State& state, void (Equilibrium::*improve)(State&)) {
  const bool behind = ramp_.motion(factor) != state.motion_factor;
  if (behind) follows_ = follow_motions(factor, state);
  const bool followed = behind && follows_;
  evaluate(state);
  for (int iteration = 0;; ++iteration) {
    const bool reached = this->reached();
    judged_ = true;
    if (iteration > 0 && reached) return iteration + (followed ? 1 : 0);
    if (!r_.allFinite()) return -1;
    if (iteration == options_.iterations) {
      if (tangent_.runs_loose(delta_)) fall(state);
      return -1;
    }
    (this->*improve)(state);
    if (iteration == 0 && !followed) note_first();
  }
}

int Equilibrium::iterate_relaxing(double factor, State& state) {
  constexpr int most_iterations = 300;
  apply_motions(system_, ramp_.motion(factor), state);
  evaluate(state);
  NewtonMatrix assembled(system_);  // inertia does not act at rest: rounding of its forces does not count
  length_ = std::max(model_length(state), longest_arm_of_inertia(state, assembled));
  double tau_squared = first_tau_squared(state);
  for (int iteration = 0; iteration < most_iterations && r_.allFinite(); ++iteration) {
    assembled.assemble(state, environment_, TangentWeights{1, 0, 0, 0, 1, true}, nullptr);
    convergence_.measure_rounding(assembled, state);
    const bool reached = this->reached();
    judged_ = true;
    if (iteration > 0 && reached) return iteration;
    this->factor(state, 1 / tau_squared);
    const double before = convergence_.size_of(r_);
    solve();
    if (const double excess = extent(state) / longest; excess > 1) {
      tau_squared /= 2 * excess;
      continue;
    }
    const State base = state;
    move(state, base, 1);
    evaluate(state);
    tau_squared *= std::clamp(before / convergence_.size_of(r_), 1.0, 10.0);
  }
  return -1;
}

/// Returns the last solution's largest rotation [rad].
double Equilibrium::largest_turn() const {
  double turn = 0;
  for (int i = 0; i < system_.dofs(); ++i)
    if (system_.kind(i) == Kind::rotation) turn = std::max(turn, std::abs(delta_[i]));
  return turn;
}

/// Returns the largest radius of gyration about a node [m], including the distance of the centre of mass: the size of a
/// body whose node is at the origin.
double Equilibrium::longest_arm_of_inertia(const State& state, NewtonMatrix& mass) const {
  mass.assemble(state, environment_, TangentWeights{0, 0, 1, 0, 0}, nullptr);
  double translation = 0, rotation = 0;
  for (int i = 0; i < system_.dofs(); ++i) {
    if (system_.kind(i) == Kind::translation) translation = std::max(translation, mass.diagonal(i));
    if (system_.kind(i) == Kind::rotation) rotation = std::max(rotation, mass.diagonal(i));
  }
  return translation > 0 ? std::sqrt(rotation / translation) : 0;
}

/// Returns the last solution's largest rotation, or its largest displacement relative to the mechanism's size.
double Equilibrium::extent(const State& state) const {
  double displacement = 0;
  for (int i = 0; i < system_.dofs(); ++i)
    if (system_.kind(i) == Kind::translation) displacement = std::max(displacement, std::abs(delta_[i]));
  return std::max(largest_turn(), displacement / std::max(length_, model_length(state)));
}

/// Returns the square of the time in which the accelerations at rest cause a motion of a fraction of `longest`.
double Equilibrium::first_tau_squared(const State& state) {
  State released = state;
  make_accelerations_consistent(system_, environment_, released);
  VectorX unused(system_.dofs());
  system_.get_rates(released, unused, delta_.head(system_.dofs()));
  const double rate = extent(state);
  return rate > 0 ? 0.3 * longest / rate : 1;
}

bool Equilibrium::follow_motions(double factor, State& state) {
  VectorX by_motion(system_.size());
  ramp_.motion_derivative(state, environment_, by_motion);
  if (by_motion.isZero(0)) {
    state.motion_factor = ramp_.motion(factor);
    return false;
  }
  evaluate(state);
  this->factor(state);
  r_ += (ramp_.motion(factor) - state.motion_factor) * by_motion;
  solve();
  note_first();
  before_ = state;
  stepped_ = true;
  state.motion_factor = ramp_.motion(factor);
  move(state, before_, 1);
  return true;
}

bool Equilibrium::reached() {
  const bool in_balance = convergence_.reached(r_, scale_);
  return in_balance && (!further_ || further_->reached(scale_));
}

/// Returns the largest force times the largest displacement of a node along z, including carried ones, or the same for
/// moments and rotations.
double Equilibrium::largest_work(const State& state, const VectorX& z) const {
  State moving = state, resting = state;
  const VectorX zero = VectorX::Zero(system_.dofs());
  system_.set_rates(moving, z, zero);
  system_.set_rates(resting, zero, zero);  // driven nodes have their own rates
  double largest = 0;
  for (std::size_t k = 0; k < state.nodes.size(); ++k)
    largest = std::max({largest, scale_[Kind::translation] * (moving.nodes[k].v - resting.nodes[k].v).norm(),
                        scale_[Kind::rotation] * (moving.nodes[k].Omega - resting.nodes[k].Omega).norm()});
  return largest;
}

/// Removes loads on loose motions that balance each other. The last solution has the component z = P P delta along
/// motions that only StaticTangent holds, with P = (K + H)^-1 H and its small stiffness H: P is one for indifferent
/// motions and almost zero for all others. If the load along z, z r, is a rounding error relative to the largest forces
/// at their lever arms (weights of a rotor's blades, given with limited accuracy, that balance each other), it is
/// neglected: the motion along z is zero, and the force H z (z r)/(z H z) is omitted from then on.
void Equilibrium::leave_balanced_out(const State& state) {
  constexpr double share = 1e-7;  // relative to the largest
  const int n = system_.dofs();
  const VectorX& H = *held();
  VectorX load = VectorX::Zero(system_.size()), loose = delta_;
  for (int purified = 0; purified < 2; ++purified) {
    load.head(n) = -H.cwiseProduct(loose.head(n));
    if (further_)
      further_->solve_along(tangent_, load, loose);
    else
      tangent_.solve(load, loose);
  }
  const VectorX z = loose.head(n), Hz = H.cwiseProduct(z);
  const double along = r_.head(n).dot(z), stiffness = z.dot(Hz);
  if (!(stiffness > 0) || !(std::abs(along) <= share * largest_work(state, z))) return;
  if (balanced_.size() == 0) balanced_ = VectorX::Zero(n);
  balanced_ += along / stiffness * Hz;
  r_.head(n) -= along / stiffness * Hz;
  delta_ -= loose;
}

/// Throws if the last solution diverges along motions that only StaticTangent holds.
void Equilibrium::check_no_fall(const State& state) {
  if (!held()) return;
  leave_balanced_out(state);
  if (extent(state) > runaway && tangent_.runs_loose(delta_)) fall(state);
}

/// Throws because the last solution continues along motions that only StaticTangent holds, either far at once or a
/// little in each iteration.
void Equilibrium::fall(const State& state) {
  falls_ = true;
  throw ComputationError(fmt::format("nothing holds {} against its load", moves_most(system_, delta_, state)));
}

void Equilibrium::step(State& state) {
  factor(state);
  solve();
  check_no_fall(state);
  before_ = state;
  stepped_ = true;
  const double turn = largest_turn();
  for (double part = turn > longest_turn ? longest_turn / turn : 1;; part /= 2) {
    try {
      move(state, before_, part);
      evaluate(state);
      if (r_.allFinite() || part < least_share) return;
    } catch (const ComputationError&) {
      if (!options_.line_search || part < least_share) throw;  // a component cannot be evaluated
    }
  }
}

void Equilibrium::search_step(State& state) {
  stepped_ = false;
  factor(state);
  const double before = convergence_.size_of(r_);
  solve();
  const State base = state;
  const auto size_at = [&](double part) {
    move(state, base, part);
    evaluate(state);
    return convergence_.size_of(r_);
  };
  const auto smaller = [&](double part) {
    try {
      return size_at(part) <= before;
    } catch (const ComputationError&) {
      return false;  // a component cannot be evaluated
    }
  };
  for (double part = 1; options_.line_search && part > least_share; part /= 2)
    if (smaller(part)) return;
  size_at(1);  // Newton's method may have to increase the residual temporarily
}

void Equilibrium::factor(const State& state, double inertia) {
  environment_.before = stepped_ ? &before_ : nullptr;
  tangent_.factor(state, environment_, inertia);
  environment_.before = nullptr;
  last_sign_ = tangent_.linear().determinant_sign();
  if (inertia == 0) convergence_.measure_rounding(tangent_.linear(), state);
  convergence_.measure_by(scale_);
}

void Equilibrium::solve() {
  ++solves_;
  if (further_)
    further_->solve(tangent_, r_, delta_);
  else
    tangent_.solve(r_, delta_);
}

void Equilibrium::move(State& state, const State& base, double part) {
  if (further_) further_->move(state, part);
  system_.displace(state, base, part * delta_.head(system_.dofs()));
  state.first_order = base.first_order + part * delta_.segment(system_.dofs(), system_.first_orders());
  state.multiplier = base.multiplier + part * delta_.tail(system_.multipliers());
}

void Equilibrium::evaluate(State& state) {
  reactions_.balance(environment_, state);
  // There may be no balance while the other unknowns have not converged: the state is then used unchanged.
  if (searches_) search_.find(environment_, state);
  residual_at_rest(system_, environment_, state, r_, &scale_);
  if (push_.size() > 0) r_.head(push_.size()) -= push_;
  if (balanced_.size() > 0) r_.head(balanced_.size()) -= balanced_;
  if (further_) further_->add_forces(environment_, state, r_);
}

}  // namespace bielle::mechanism
