#include "mechanism/elements/superelement/validity.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

// Error of displacements divided by theta^2, for bending by interfaces. The second value is used if rotations are
// determined by lines only, since no rotations act then.
constexpr double error_per_square = 0.006, error_of_lines = 0.05;
constexpr double error_of_free_end = 0.4, error_between = 0.03;  // error divided by theta, for bending in the modes
constexpr double worth_a_line = 1e-3, worth_a_warning = 5e-3;
constexpr double much_strain = 0.02;
constexpr double turn_over_chord = 1.5;  // theta L / deflection of a bar under a force at its end
constexpr std::size_t most_chords = 12;  // chords are compared between at most this number of points

bool turns(const BodyPoint& point) { return point.rotation.kind() == InterfaceRotation::Kind::vector; }

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Returns the angle of a rotation without its axis.
double angle_of(const Matrix3& R) { return std::acos(std::clamp((R.trace() - 1) / 2, -1.0, 1.0)); }

/// Returns the rotation from body axes to inertial ones, as given by the interface.
Matrix3 axes_of(const BodyPoint& point, const LocalState& state, std::size_t k) {
  return state.node(static_cast<int>(k)).R * point.R_ref.transpose();
}

/// Returns the rotation of the line from an interface to another one whose rotations are not all connected, in the axes
/// of the first interface.
double turn_of_chord(const std::vector<BodyPoint>& points, const LocalState& state, std::size_t from, std::size_t to) {
  const Vector3 drawn = points[to].X - points[from].X;
  const Vector3 now = state.node(static_cast<int>(to)).x - state.node(static_cast<int>(from)).x;
  return angle_between(drawn, axes_of(points[from], state, from).transpose() * now);
}

/// Returns the change of the angle between the lines to two interfaces.
double turn_of_chords(const std::vector<BodyPoint>& points, const LocalState& state, std::size_t at, std::size_t a,
                      std::size_t b) {
  const auto now = [&](std::size_t k) -> Vector3 {
    return state.node(static_cast<int>(k)).x - state.node(static_cast<int>(at)).x;
  };
  return std::abs(angle_between(now(a), now(b)) -
                  angle_between(points[a].X - points[at].X, points[b].X - points[at].X));
}

/// Returns the largest change of an angle between such lines. It is used if no two interfaces have rotations that can
/// be compared.
double largest_turn_of_chords(const std::vector<BodyPoint>& points, const LocalState& state) {
  const std::size_t count = std::min(points.size(), most_chords);
  double largest = 0;
  for (std::size_t at = 0; at < count; ++at)
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (a != at && b != at && points[at].keeps_position && points[a].keeps_position && points[b].keeps_position)
          largest = std::max(largest, turn_of_chords(points, state, at, a, b));
  return largest;
}

/// Returns whether all interfaces are at one end of the body, or in its middle: their largest distance is less than
/// half the length of a bar with the same radius of gyration, L = sqrt(12) k.
bool leave_an_end_free(const std::vector<BodyPoint>& points, double gyration) {
  double largest = 0;
  for (const BodyPoint& a : points)
    for (const BodyPoint& b : points) largest = std::max(largest, (a.X - b.X).norm());
  return largest < 0.5 * std::sqrt(12.0) * gyration;
}

}  // namespace

BodyTurn largest_turn(const std::vector<BodyPoint>& points, const LocalState& state) {
  BodyTurn turn;
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!turns(points[i])) continue;
    any = true;
    const Matrix3 R = axes_of(points[i], state, i);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k < i && turns(points[k]))
        turn.of_interfaces = std::max(turn.of_interfaces, angle_of(R.transpose() * axes_of(points[k], state, k)));
      else if (!turns(points[k]) && points[i].keeps_position && points[k].keeps_position)
        turn.of_lines = std::max(turn.of_lines, turn_over_chord * turn_of_chord(points, state, i, k));
  }
  if (!any) turn.of_lines = turn_over_chord * largest_turn_of_chords(points, state);
  return turn;
}

double largest_turn_of_modes(const MatrixX& mode_turns, const LocalState& state) {
  if (mode_turns.size() == 0) return 0;
  thread_local VectorX turn;
  turn.noalias() = mode_turns * state.amplitude();
  double largest = 0;
  for (Eigen::Index k = 0; k + 2 < turn.size(); k += 3)
    for (Eigen::Index i = 0; i < k; i += 3)
      largest = std::max(largest, (turn.segment<3>(k) - turn.segment<3>(i)).squaredNorm());
  return std::sqrt(largest);
}

Validity::Validity(std::string body, const std::vector<BodyPoint>& points, ValidityMeasures measures,
                   std::shared_ptr<const BodyDeformation> deformation)
    : body_(std::move(body)),
      points_(points),
      measures_(std::move(measures)),
      deformation_(std::move(deformation)),
      error_per_mode_turn_(leave_an_end_free(points, measures_.gyration) ? error_of_free_end : error_between) {}

std::string Validity::when(double time, bool statics) {
  return statics ? fmt::format("load factor {:.6g}", time) : fmt::format("t = {:.6g} s", time);
}

std::string Validity::bends() const {
  if (cause_ == Cause::strains) return fmt::format("is strained by {:.2g} % in the mean", 100 * error_);
  return fmt::format("bends by {:.2g} rad {}", turn_,
                     cause_ == Cause::bends_in_modes ? "in its modes" : "between its interfaces");
}

void Validity::begin() {
  error_ = turn_ = time_ = strain_ = time_of_strain_ = 0;
  cause_ = Cause::bends;
  statics_ = false;
}

void Validity::note(double error, double turn, Cause cause, const LocalState& state) {
  if (!(error > error_)) return;
  error_ = error;
  turn_ = turn;
  cause_ = cause;
  time_ = statics_ ? state.environment().load_factor : state.time();
  if (const auto most = measures_.most; most && error_ > *most)
    throw ComputationError(
        fmt::format("{}: superelement '{}' {}; its deformation is wrong by about {:.2g}, more than its "
                    "`largest_error`, {:.2g}: {}",
                    when(time_, statics_), body_, bends(), error_, *most,
                    cause_ == Cause::strains ? "its elasticity is linear" : "cut it into pieces"));
}

void Validity::add(const LocalState& state) {
  statics_ = state.environment().statics;
  const BodyTurn turn = largest_turn(points_, state);
  const double of_modes = largest_turn_of_modes(measures_.mode_turns, state);
  const StrainSizes strain = measures_.strain.calc(deformation_->eps);
  note(error_per_square * turn.of_interfaces * turn.of_interfaces, turn.of_interfaces, Cause::bends, state);
  note(error_of_lines * turn.of_lines * turn.of_lines, turn.of_lines, Cause::bends, state);
  note(error_per_mode_turn_ * of_modes, of_modes, Cause::bends_in_modes, state);
  note(strain.mean, 0, Cause::strains, state);
  if (!(strain.largest > strain_)) return;
  strain_ = strain.largest;
  time_of_strain_ = statics_ ? state.environment().load_factor : state.time();
}

void Validity::exchange(Archive& archive) {
  for (double* value : {&error_, &turn_, &time_, &strain_, &time_of_strain_}) archive(*value);
  bool in_modes = cause_ == Cause::bends_in_modes, strains = cause_ == Cause::strains;
  archive(in_modes);
  archive(strains);
  cause_ = strains ? Cause::strains : in_modes ? Cause::bends_in_modes : Cause::bends;
  archive(statics_);
}

std::vector<ResultArray> Validity::results() {
  const std::string group = fmt::format("validity/{}/", body_);
  return {{group + "error", {}, {error_}, "-", "largest estimate of the relative error of the body's deformation"},
          {group + "turn",
           {},
           {turn_},
           "rad",
           "of an interface, or a place in the modes, relative to another there; 0 where strain is the cause"},
          {group + "time", {}, {time_}, statics_ ? "-" : "s", statics_ ? "load factor" : "when it was reached"},
          {group + "strain", {}, {strain_}, "-", "largest strain at places spread over the body"}};
}

std::string Validity::summary() {
  std::string text;
  const bool warns = error_ > worth_a_warning;
  if (error_ >= worth_a_line)
    text = fmt::format("  {}superelement '{}' {} at {}: its deformation is wrong by about {:.{}g} %{}\n",
                       warns ? "warning: " : "", body_, bends(), when(time_, statics_), 100 * error_,
                       error_ < 0.095 ? 1 : 2,
                       !warns                     ? ""
                       : cause_ == Cause::strains ? ", since its elasticity is linear"
                                                  : "; cut it into pieces");
  if (strain_ >= much_strain && !(warns && cause_ == Cause::strains && error_ > 0.5 * strain_))
    text += fmt::format(
        "  warning: superelement '{}' is strained by {:.2g} % at {}: its elasticity is linear, for small strains\n",
        body_, 100 * strain_, when(time_of_strain_, statics_));
  return text;
}

}  // namespace bielle::mechanism
