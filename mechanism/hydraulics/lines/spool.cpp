#include "mechanism/hydraulics/lines/spool.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/hydraulics/lines/opening_lock.hpp"
#include "mechanism/measures/nested.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {
namespace {

constexpr double most_opening = 1;

}  // namespace

void Spool::read_dynamics(const YamlValue& entry) {
  const auto constant = entry.find("time_constant"), frequency = entry.find("frequency"),
             damping = entry.find("damping");
  if (constant && frequency)
    frequency->fail("give `time_constant` (first order) or `frequency` (second order), not both");
  if (damping && !frequency) damping->fail("belongs to a `frequency` (second order)");
  if (constant) {
    time_constant_ = constant->number();
    order_ = time_constant_ > 0 ? 1 : 0;
  }
  if (frequency) {
    order_ = 2;
    omega_ = 2 * M_PI * frequency->number();
    damping_ = entry.at("damping").number();
    warn_outside(entry.at("damping"), damping_, plausible_damping_ratio);
  }
}

void Spool::read_command(const YamlValue& command, Model& model, References& references) {
  command_ = read_state_formula(command, {"t"}, model, references);
}

void Spool::declare(Declaration& declaration) const {
  declaration.memory = OpeningLock::start_memory();
  declaration.reads_reactions = declaration.reads_reactions || reads_reactions();
  if (reads_state() || order_ > 0) declaration.damping = true;
  if (order_ == 0) return;
  declaration.starts_by_state = true;
  Declaration::Scalar opening{"opening", "-", 0};
  opening.scale = 1;
  opening.equation_units = "1/s";
  declaration.first_order.push_back(opening);
  if (order_ == 1) return;
  Declaration::Scalar speed{"speed of the spool", "1/s", 0};
  speed.scale = omega_;
  speed.equation_units = "1/s^2";
  declaration.first_order.push_back(speed);
}

double Spool::command(const LocalState& state) const {
  const double t = state.time();
  return command_.value(state, {&t, 1});
}

double Spool::opening(const LocalState& state) const {
  if (OpeningLock::is_locked(state)) return OpeningLock::kept_opening(state);
  return order_ == 0 ? command(state) : state.first_order()[0];
}

double Spool::opening(const LocalState& state, MeasureGradient& gradient) const {
  if (OpeningLock::is_locked(state)) return OpeningLock::kept_opening(state);
  if (order_ > 0) {
    gradient.position()[state.slots().first_order_row()] = 1;
    return state.first_order()[0];
  }
  if (!command_.reads_state()) return command(state);
  const double t = state.time();
  Nested<FormulaGradient> command;
  command_.calc(state, {&t, 1}, *command);
  gradient.position() = command->by_state.position();
  gradient.rate() = command->by_state.rate();
  return command->value;
}

void Spool::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  if (order_ == 0) return;
  const int row = state.slots().first_order_row();
  const auto y = state.first_order(), rate = state.first_order_rate();
  for (int k = 0; k < order_; ++k) r[row + k] += rate[k];
  if (OpeningLock::is_locked(state)) return;
  const double u = command(state);
  if (order_ == 1) {
    r[row] -= (u - y[0]) / time_constant_;
    return;
  }
  const double w = y[1] - OpeningLock::kept_speed(state);
  r[row] -= w;
  r[row + 1] -= omega_ * omega_ * (u - y[0]) - 2 * damping_ * omega_ * w;
}

void Spool::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (order_ == 0) return;
  const int row = state.slots().first_order_row(), driven = row + order_ - 1;
  const double gain = order_ == 1 ? 1 / time_constant_ : omega_ * omega_;
  if (tangent.wants_C)
    for (int k = 0; k < order_; ++k) tangent.C.dense()(row + k, row + k) += 1;
  if (OpeningLock::is_locked(state)) {
    // Residuals of statics are zero: any slope along the unknowns makes their increments zero.
    if (tangent.wants_K && state.environment().statics)
      for (int k = 0; k < order_; ++k) tangent.K.dense()(row + k, row + k) += 1;
    return;
  }
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K(driven, row) += gain;
    if (order_ == 2) {
      K(row, row + 1) -= 1;
      K(row + 1, row + 1) += 2 * damping_ * omega_;
    }
  }
  if (!command_.reads_state()) return;
  const double t = state.time();
  Nested<FormulaGradient> command;
  command_.calc(state, {&t, 1}, *command);
  if (tangent.wants_K) tangent.K.dense().row(driven) -= gain * command->by_state.position().transpose();
  if (tangent.wants_C) tangent.C.dense().row(driven) -= gain * command->by_state.rate().transpose();
}

void Spool::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  if (order_ > 0) pattern.add_block(slots.first_order_row(), 0, order_, slots.size());
}

void Spool::add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const {
  if (order_ == 0 || state.memory()[OpeningLock::begun] != 0) return;
  const int row = state.slots().first_order_row();
  change[row] += command(state) - state.first_order()[0];
  if (order_ == 2) change[row + 1] -= state.first_order()[1];
}

void Spool::check(const LocalState& state, const std::string& name) const {
  if (OpeningLock::is_locked(state)) return;
  const double u = command(state);
  constexpr double rounding = 1e-9;
  if (u >= least_ - rounding && u <= most_opening + rounding) return;
  throw ComputationError(
      fmt::format("t = {:.6g} s: the command of valve '{}' is {:.6g}: expected {:.6g} to {:.6g}, a share of the full "
                  "opening; limit it in its formula, as in max({:.6g}, min(1, ..))",
                  state.time(), name, u, least_, most_opening, least_));
}

std::string Spool::describe() const {
  std::string text = fmt::format("command {}", command_.text());
  if (order_ == 1) text += fmt::format(", spool of first order, {:.6g} s", time_constant_);
  if (order_ == 2)
    text += fmt::format(", spool of second order, {:.6g} Hz, damping ratio {:.6g}", omega_ / (2 * M_PI), damping_);
  return text;
}

std::vector<Key> spool_keys(double least, const std::string& command) {
  using namespace keys;
  return {{"command", state_formula("", {"t"}).between(least, most_opening), required, command},
          {"overlap", number().inside(-1, 1), otherwise("0"),
           "Overlap of the edges of the spool, as a share of the full opening; negative values mean underlap."},
          time_constant_key(),
          {"frequency", number("Hz").positive(), optional,
           "Natural frequency with which the opening follows the command (second order), in place of `time_constant`."},
          {"damping", number().non_negative(), otherwise("0.7"), "Damping ratio of the second order."}};
}

Key time_constant_key() {
  return {"time_constant", keys::number("s").non_negative(), keys::otherwise("0"),
          "Time constant with which the opening follows (first order); with 0 it follows at once."};
}

}  // namespace bielle::mechanism
