#include "mechanism/elements/superelement/validity.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr double error_per_square = 0.006;  // relative error of displacements over theta^2
constexpr double worth_a_line = 1e-3, worth_a_warning = 5e-3;

}  // namespace

double largest_turn(const std::vector<BodyPoint>& points, const LocalState& state) {
  double largest = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].rotation.kind() != InterfaceRotation::Kind::vector) continue;
    const Matrix3 R = state.node(static_cast<int>(k)).R * points[k].R_ref.transpose();
    for (std::size_t i = 0; i < k; ++i) {
      if (points[i].rotation.kind() != InterfaceRotation::Kind::vector) continue;
      const Matrix3 relative = points[i].R_ref * state.node(static_cast<int>(i)).R.transpose() * R;
      // The angle of a rotation without its axis.
      largest = std::max(largest, std::acos(std::clamp((relative.trace() - 1) / 2, -1.0, 1.0)));
    }
  }
  return largest;
}

double Validity::error() const { return error_per_square * turn_ * turn_; }

std::string Validity::when() const {
  return statics_ ? fmt::format("load factor {:.6g}", time_) : fmt::format("t = {:.6g} s", time_);
}

void Validity::begin() {
  turn_ = time_ = 0;
  statics_ = false;
}

void Validity::add(const LocalState& state) {
  const double turn = largest_turn(points_, state);
  if (!(turn > turn_)) return;
  turn_ = turn;
  statics_ = state.environment().statics;
  time_ = statics_ ? state.environment().load_factor : state.time();
  if (most_ && error() > *most_)
    throw ComputationError(
        fmt::format("{}: superelement '{}' bends by {:.3g} rad between its interfaces; its deformation is wrong by about "
                    "{:.2g}, more than its `largest_error`, {:.2g}: cut it into pieces",
                    when(), body_, turn_, error(), *most_));
}

void Validity::exchange(Archive& archive) {
  for (double* value : {&turn_, &time_}) archive(*value);
  archive(statics_);
}

std::vector<ResultArray> Validity::results() {
  const std::string group = fmt::format("validity/{}/", body_);
  return {{group + "error", {}, {error()}, "-", "largest estimate of the relative error of the body's deformation"},
          {group + "turn", {}, {turn_}, "rad", "of an interface relative to another there"},
          {group + "time", {}, {time_}, statics_ ? "-" : "s", statics_ ? "load factor" : "when it was reached"}};
}

std::string Validity::summary() {
  if (error() < worth_a_line) return {};
  const bool warns = error() > worth_a_warning;
  return fmt::format("  {}superelement '{}' bends by {:.2g} rad between its interfaces at {}: its deformation is wrong by about "
                     "{:.1g} %{}\n",
                     warns ? "DOUBTFUL: " : "", body_, turn_, when(), 100 * error(), warns ? "; cut it into pieces" : "");
}

}  // namespace bielle::mechanism
