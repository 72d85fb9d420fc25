#include "mechanism/solvers/time_integration.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/solvers/massless_balance.hpp"
#include "mechanism/solvers/redundancy.hpp"

namespace bielle::mechanism {
namespace {

/// Turn of a node in one step beyond which T(Dq) is not to be trusted: it is singular at a full turn [rad].
constexpr double most_turn = 0.9 * 2 * 3.14159265358979324;

/// Distance from a kink at which its two sides are told apart in spite of rounding [s].
double beside(double time, double h) { return 1e-12 * h + 8 * std::numeric_limits<double>::epsilon() * std::abs(time); }

}  // namespace

TimeIntegration::TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme,
                                 State state, ConstraintForm form, const NewtonOptions& options)
    : system_(system),
      environment_(environment),
      scheme_(scheme),
      state_(std::move(state)),
      linear_(system),
      options_(options),
      convergence_(system, options),
      form_(form),
      saddle_(system),
      reactions_(system) {
  allocate();
  start_report_ = make_consistent(system_, environment_, state_);
  take_rates();
  system_.accept(state_, environment_);
  next_ = state_;
}

TimeIntegration::TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme,
                                 Archive& archive, ConstraintForm form, const NewtonOptions& options)
    : system_(system),
      environment_(environment),
      scheme_(scheme),
      state_(system.start(0)),
      linear_(system),
      options_(options),
      convergence_(system, options),
      form_(form),
      saddle_(system),
      reactions_(system) {
  allocate();
  exchange(archive);
  next_ = state_;
}

void TimeIntegration::allocate() {
  for (VectorX* vector : {&v_, &a_, &A_, &dq_, &v_new_, &a_new_, &j_, &last_dq_}) vector->setZero(system_.dofs());
  Y_ = state_.first_order_rate;
  Y_rate_.setZero(system_.first_orders());
  if (form_ == ConstraintForm::stabilised && system_.multipliers() > 0)
    stabilised_ = std::make_unique<StabilisedStep>(system_);
  eta_.setZero(system_.dofs());
  mu_.setZero(system_.multipliers());
  const int size = stabilised_ ? stabilised_->size() : system_.size();
  r_.setZero(size);
  r_evaluated_.setZero(size);
  delta_.setZero(size);
}

void TimeIntegration::exchange(Archive& archive) {
  archive(state_);
  for (VectorX* vector : {&v_, &a_, &A_, &j_, &Y_, &Y_rate_}) archive(*vector);
  archive(Y_rate_known_);
  archive(turning_);
  archive(h_);
  linear_.choose_pivots_anew();
  if (stabilised_) stabilised_->choose_pivots_anew();
  saddle_.choose_pivots_anew();
  factored_for_ = 0;
  floor_age_ = never_measured;
}

void TimeIntegration::take_rates() {
  system_.get_rates(state_, v_, a_);
  A_ = a_;
  Y_ = state_.first_order_rate;
  Y_rate_known_ = false;
}

VectorX TimeIntegration::acceleration_rate(double h) {
  // Forward differences of the consistent accelerations along the motion: functions of time may not exist before the
  // start. The step has to be small beside h only.
  const double e = 0.05 * h;
  VectorX ahead[2];
  for (const int k : {1, 2}) {
    State shifted = state_;
    shifted.time = state_.time + k * e;
    system_.displace(shifted, state_, k * e * v_ + 0.5 * k * k * e * e * a_);
    system_.set_rates(shifted, v_ + k * e * a_, a_);
    shifted.first_order = state_.first_order + k * e * state_.first_order_rate;
    make_accelerations_consistent(system_, environment_, shifted, saddle_);
    VectorX unused(system_.dofs());
    ahead[k - 1].resize(system_.dofs());
    system_.get_rates(shifted, unused, ahead[k - 1]);
  }
  return (4 * ahead[0] - ahead[1] - 3 * a_) / (2 * e);
}

bool TimeIntegration::resolved(const VectorX& j, double h) const {
  // Per kind: the accelerations change by less than themselves, or the velocities by little where accelerations happen
  // to vanish (an oscillator on its way through the middle: h^2 j / v = (omega h)^2).
  constexpr double little = 0.01;
  std::array<double, kind_count> velocity{}, acceleration{}, rate{};
  for (int i = 0; i < system_.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system_.kind(i));
    velocity[kind] = std::max(velocity[kind], std::abs(v_[i]));
    acceleration[kind] = std::max(acceleration[kind], std::abs(a_[i]));
    rate[kind] = std::max(rate[kind], std::abs(j[i]));
  }
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (h * rate[kind] > acceleration[kind] && h * h * rate[kind] > little * velocity[kind]) return false;
  return true;
}

void TimeIntegration::start(double h) {
  h_ = h;
  if (!saddle_.serves()) saddle_.factor(environment_, state_);
  j_ = acceleration_rate(h);
  set_start_values(h);
  saddle_.serve_no_more();
}

void TimeIntegration::set_start_values(double h) {
  // The corrections are terms of a series in h. Where the accelerations change by their own size within a step (stiff
  // bodies set off suddenly), they would add what the scheme then has to damp.
  if (!resolved(j_, h)) return;
  A_ = a_ + scheme_.delta() * h * j_;
  perturb_velocity(j_, h * h);
  system_.set_rates(state_, v_, a_);
}

void TimeIntegration::change_step(double h) {
  if (same_size(h, h_)) return;
  if (resolved(j_, std::max(h, h_))) {
    A_ += scheme_.delta() * (h - h_) * j_;
    perturb_velocity(j_, h * h - h_ * h_);
    saddle_.serve_no_more();
    system_.set_rates(state_, v_, a_);
  }
  h_ = h;
}

void TimeIntegration::restart(double h) {
  const double time = state_.time;
  state_.time += beside(time, h);
  StartReport unused;
  start_anew(h, unused);
  state_.time = time;
}

void TimeIntegration::start_anew(double h, StartReport& report) {
  // One factorisation serves all of it.
  make_velocities_consistent(system_, environment_, state_, report, saddle_);
  make_accelerations_consistent(system_, environment_, state_, saddle_);
  balance_massless(system_, environment_, state_, report);
  take_rates();
  start(h);
}

Jump TimeIntegration::begin_branch(double h, const std::vector<int>& crossed) {
  Jump jump;
  jump.time = state_.time;
  jump.crossed = crossed;
  jump.before = system_.energy(state_, environment_);
  state_.time += beside(jump.time, h);
  system_.begin_branch(state_, environment_, crossed);
  set_redundant_aside(system_, environment_, state_);
  StartReport report;
  start_anew(h, report);
  factored_for_ = 0;
  jump.after = system_.energy(state_, environment_);
  jump.work = report.impulse_work;
  state_.time = jump.time;
  return jump;
}

VectorX TimeIntegration::algorithmic_acceleration() const {
  const auto& [alpha_m, alpha_f, gamma, beta] = scheme_;
  return ((1 - alpha_f) * a_new_ + alpha_f * a_ - alpha_m * A_) / (1 - alpha_m);
}

VectorX TimeIntegration::algorithmic_rate() const {
  const auto& [alpha_m, alpha_f, gamma, beta] = scheme_;
  return ((1 - alpha_f) * next_.first_order_rate + alpha_f * state_.first_order_rate - alpha_m * Y_) / (1 - alpha_m);
}

void TimeIntegration::predict(double h, double end) {
  const auto& [alpha_m, alpha_f, gamma, beta] = scheme_;
  rate_factor_ = gamma / (beta * h);
  acceleration_factor_ = (1 - alpha_m) / ((1 - alpha_f) * beta * h * h);
  first_order_factor_ = (1 - alpha_m) / ((1 - alpha_f) * gamma * h);
  if (stabilised_) stabilised_->begin(state_, environment_);
  // The accelerations stay.
  a_new_ = a_;
  next_.first_order_rate = state_.first_order_rate;
  calc_prediction(h, dq_, v_new_, next_.first_order);
  next_.time = end;
  next_.multiplier = state_.multiplier;
  next_.memory = state_.memory;
  next_.idle = state_.idle;
  eta_.setZero();
  mu_.setZero();
}

/// Increments, velocities and first-order unknowns at the end of a step with the accelerations and rates of its
/// beginning.
void TimeIntegration::calc_prediction(double h, VectorX& dq, VectorX& v, VectorX& y) const {
  const auto& [alpha_m, alpha_f, gamma, beta] = scheme_;
  const auto A = (a_ - alpha_m * A_) / (1 - alpha_m);
  const auto Y = (state_.first_order_rate - alpha_m * Y_) / (1 - alpha_m);
  dq = h * v_ + h * h * ((0.5 - beta) * A_ + beta * A);
  v = v_ + h * ((1 - gamma) * A_ + gamma * A);
  y = state_.first_order + h * ((1 - gamma) * Y_ + gamma * Y);
}

/// T(Dq) is singular where a node makes a full turn in one step, and the rotation is that of none.
void TimeIntegration::check_turns() const {
  if (dq_.lpNorm<Eigen::Infinity>() < most_turn / 2) return;  // as nearly always
  for (std::size_t i = 0; i < next_.nodes.size(); ++i) {
    const NodeFreedom& f = system_.kinematics().freedom(static_cast<int>(i));
    if (f.rotations != 3) continue;
    if (const double turn = dq_.segment<3>(f.begin + f.count - 3).norm(); turn > most_turn)
      throw ComputationError(fmt::format(
          "t = {:.6g} s: node '{}' turns by {:.3g} rad in one step of {:.3g} s; the scheme needs less than {:.3g} rad",
          next_.time, system_.model().node(static_cast<int>(i)).name, turn, attempted_, most_turn));
  }
}

StepReport TimeIntegration::attempt(double h, double end, bool kink) {
  attempted_ = h;
  end_ = end;
  ++floor_age_;
  StepReport report;
  report.size = h;
  try {
    predict(h, kink ? end - beside(end, h) : end);
    for (evaluate();; improve(report)) {
      if (reached(report)) break;
      if (report.iterations == options_.iterations || !finite(report)) {
        within_tolerance();
        report.refusal = fmt::format("t = {:.6g} s: Newton did not converge in {} iterations; largest residual: {}",
                                     next_.time, report.iterations, convergence_.worst());
        factored_for_ = 0;
        break;
      }
    }
    if (report.converged()) {
      if (options_.reuse_tangent) polish();
      check_turns();
    }
    report.worst_equation = convergence_.worst_equation();
    report.worst_residual = convergence_.worst_residual();
    report.worst_ratio = convergence_.worst_ratio();
  } catch (const ComputationError& error) {
    // A component refuses what it was asked for, or the equations are singular. Nearer to the last state that may not
    // be so.
    report.refusal = error.what();
    if (report.iterations > 1) {
      within_tolerance();
      report.refusal += "; before the iteration went there the largest residual was: " + convergence_.worst();
    }
    factored_for_ = 0;
  }
  return report;
}

bool TimeIntegration::accept() {
  check_set_aside(system_, environment_, next_);
  const VectorX A = algorithmic_acceleration(), Y = algorithmic_rate();
  j_ = (A - A_) / attempted_;
  Y_rate_ = (Y - Y_) / attempted_;
  Y_rate_known_ = true;
  A_ = A;
  Y_ = Y;
  watch_turns();
  v_.swap(v_new_);
  a_.swap(a_new_);
  last_dq_.swap(dq_);
  h_ = attempted_;
  const bool branch_left = system_.accept(next_, environment_);
  next_.time = end_;
  std::swap(state_, next_);
  return branch_left;
}

StepReport TimeIntegration::step(double h) {
  const StepReport report = attempt(h);
  if (!report.converged()) throw ComputationError(report.refusal);
  accept();
  return report;
}

State TimeIntegration::interpolated(double time) const {
  const State &before = next_, &after = state_;
  const double h = after.time - before.time, s = (time - before.time) / h;
  // Cubic polynomials in the chart of the step, from the values and rates at its ends.
  const double f0 = s * (1 - s) * (1 - s), f1 = s * s * (3 - 2 * s), f2 = s * s * (s - 1);
  const double d0 = (1 - s) * (1 - 3 * s), d1 = 6 * s * (1 - s), d2 = s * (3 * s - 2);
  VectorX v_before(system_.dofs()), a_before(system_.dofs());
  system_.get_rates(before, v_before, a_before);
  VectorX end_rate = v_;
  const auto rotations = [&](const auto& act) {
    for (std::size_t i = 0; i < before.nodes.size(); ++i) {
      const NodeFreedom& f = system_.kinematics().freedom(static_cast<int>(i));
      if (f.rotations == 3) act(f.begin + f.count - 3);
    }
  };
  rotations([&](int k) { end_rate.segment<3>(k) = tangent_inverse(last_dq_.segment<3>(k)) * v_.segment<3>(k); });
  const VectorX dq = f0 * h * v_before + f1 * last_dq_ + f2 * h * end_rate;
  VectorX v = d0 * v_before + d1 / h * last_dq_ + d2 * end_rate;
  rotations([&](int k) { v.segment<3>(k) = tangent(dq.segment<3>(k)) * Vector3(v.segment<3>(k)); });

  State state = before;
  state.time = time;
  system_.displace(state, before, dq);
  system_.set_rates(state, v, (1 - s) * a_before + s * a_);
  state.first_order = before.first_order + f0 * h * before.first_order_rate +
                      f1 * (after.first_order - before.first_order) + f2 * h * after.first_order_rate;
  for (const int k : system_.algebraic())
    state.first_order[k] = (1 - s) * before.first_order[k] + s * after.first_order[k];
  state.first_order_rate = (1 - s) * before.first_order_rate + s * after.first_order_rate;
  state.multiplier = (1 - s) * before.multiplier + s * after.multiplier;
  state.reaction.resize(0);
  if (before.reaction.size() > 0 || after.reaction.size() > 0) {
    const auto read = [](const State& at) { return at.reaction.size() > 0 ? at.reaction : at.multiplier; };
    state.reaction = (1 - s) * read(before) + s * read(after);
  }
  return state;
}

VectorX TimeIntegration::position_error() const {
  const double h = attempted_;
  VectorX error = scheme_.position_error() * h * h * (algorithmic_acceleration() - A_);
  for (std::size_t i = 0; i < next_.nodes.size(); ++i) {
    const NodeFreedom& f = system_.kinematics().freedom(static_cast<int>(i));
    if (f.rotations == 3)
      error.segment<3>(f.begin + f.count - 3) += h * h * h / 12 * next_.nodes[i].Omega.cross(next_.nodes[i].Omegadot);
  }
  return error;
}

VectorX TimeIntegration::first_order_error() const {
  const double h = attempted_;
  if (!Y_rate_known_) return VectorX::Zero(system_.first_orders());
  const VectorX rate = (algorithmic_rate() - Y_) / h;
  // The two rates stand at the middles of the two steps.
  return scheme_.velocity_error() * h * h * h * (rate - Y_rate_) / (0.5 * (h + h_));
}

}  // namespace bielle::mechanism
