#include "mechanism/solvers/statics/arc_length.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/held_states.hpp"
#include "mechanism/solvers/statics/path_step.hpp"
#include "mechanism/solvers/statics/root_bracket.hpp"
#include "mechanism/solvers/statics/stability.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

constexpr double longest_arc = 0.1;         // mean displacement relative to the mechanism's size, or rotation [rad]
constexpr double easy_iterations = 4;       // iterations of Newton's method: arcs grow with fewer, and shrink with more
constexpr double sharpest_bend = 0.7;       // cosine between a step and its initial tangent
constexpr double least_part = 1.0 / 16384;  // fraction of the first arc
constexpr double resolved = 1e-12;          // displacements relative to the mechanism's size

/// Condition for the distance of a point from the end of the path.
class EndCondition final : public PathCondition {
 public:
  EndCondition(const PathEnd& end, const LoadRamp& ramp, const PathStep& step)
      : end_(end), ramp_(ramp), step_(step), drawn_(ramp.system().model().node(end.node).frame.x) {}

  double gap(const State& state, double factor) const {
    if (end_.load_factor) return factor - *end_.load_factor;
    const Vector3 u = state.nodes[static_cast<std::size_t>(end_.node)].x - drawn_;
    return (end_.direction.isZero(0) ? u.norm() : end_.direction.dot(u)) - end_.displacement;
  }
  std::optional<double> load_factor() const { return end_.load_factor; }
  /// Sets the state from which the trials start.
  void set_base(const State& base) { base_ = &base; }
  double value(const PathTrial& trial) const override { return gap(trial.state, trial.factor); }
  double slope(const PathTrial& trial, const VectorX& along, double factor) const override {
    if (end_.load_factor) return factor;
    const double part = 1e-6 / std::max(step_.length(along), 1e-30);
    const auto value_at = [&](double distance) {
      PathTrial moved = trial;
      moved.delta += distance * along;
      moved.factor += distance * factor;
      step_.place(*base_, moved);
      return value(moved);
    };
    return (value_at(part) - value_at(-part)) / (2 * part);
  }
  double tolerance() const override { return end_.load_factor ? 0 : resolved * step_.extent(); }

  std::string describe(double gap) const {
    if (end_.load_factor) return fmt::format("and the end at {:.6g}", *end_.load_factor);
    return fmt::format("with {:.6g} m of the {:.6g} m that node '{}' is to move", gap + end_.displacement,
                       end_.displacement, ramp_.system().model().node(end_.node).name);
  }

 private:
  const PathEnd& end_;
  const LoadRamp& ramp_;
  const PathStep& step_;
  Vector3 drawn_;
  const State* base_ = nullptr;
};

/// The unit tangent of the path and the load factor's derivative along it.
struct Tangent {
  VectorX direction;
  double slope = 0;
};

class Path {
 public:
  Path(const LoadRamp& ramp, const ContinuationOptions& path, const NewtonOptions& options, State& state)
      : ramp_(ramp),
        system_(ramp.system()),
        path_(path),
        state_(in_equilibrium(ramp, options, state)),
        factor_(ramp.begin()),
        step_(ramp, options, state),
        stability_(ramp.system(), step_.held()),
        end_(path.end, ramp, step_),
        gap_(end_.gap(state, factor_)),
        whole_(std::abs(gap_)),
        drawn_in_a_point_(spread(state) == 0) {
    set_off();
    unstable_ = stability_.count(state_, ramp_.environment(factor_));
  }

  bool ended() const { return gap_ == 0; }
  double factor() const { return factor_; }

  /// Advances to the next point: the end of a step, a limit point within the step, or the end of the path.
  PathPoint advance() {
    for (;; refuse()) {
      trial_.delta = arc_ * tangent_.direction;
      trial_.factor = factor_ + arc_ * tangent_.slope;
      if (!correct(ArcCondition(step_, arc_), arc_)) continue;
      double length = arc_;
      Tangent after = tangent_at(trial_);
      const bool limit = going_ * after.slope <= 0;
      if (limit && !locate_limit(after, length)) continue;
      const double gap = end_.gap(trial_.state, trial_.factor);
      const double end = gap_ * gap <= 0 ? gap_ / (gap_ - gap) : std::numeric_limits<double>::infinity();
      if (const auto stop = next_stop(); stop && (*stop - factor_) / (trial_.factor - factor_) < end) {
        PathEnd here;
        here.load_factor = *stop;
        EndCondition condition(here, ramp_, step_);
        const double part = (*stop - factor_) / (trial_.factor - factor_);
        if (part < 1) {
          if (!meet(condition, part, length)) continue;
          after = tangent_at(trial_);
        }
        const double arc = arc_;
        PathPoint point = accept(end_.gap(trial_.state, trial_.factor), limit && part == 1, after, part * length);
        arc_ = arc;
        return point;
      }
      if (gap_ * gap <= 0) {
        if (!meet(end_, end, length)) continue;
        return accept(0, false, after, length);
      }
      return accept(gap, limit, after, length);
    }
  }

  std::string describe_end() const { return end_.describe(gap_); }

 private:
  static State& in_equilibrium(const LoadRamp& ramp, const NewtonOptions& options, State& state) {
    Equilibrium equilibrium(ramp, options);
    equilibrium.look_for_loose(ramp.begin(), state);
    if (equilibrium.find(ramp.begin(), state) < 0)
      throw ComputationError(fmt::format("static path: no equilibrium to begin from at load factor {:.6g}: {}",
                                         ramp.begin(), equilibrium.why()));
    equilibrium.accept(ramp.begin(), state);
    return state;
  }

  /// Computes the first tangent and the first arc.
  void set_off() {
    if (whole_ <= (path_.end.load_factor ? 0 : resolved * step_.extent()))
      throw ComputationError("static path: its end is where it begins");
    VectorX b;
    if (!step_.response(state_, factor_, b))
      throw ComputationError(
          fmt::format("static path: the equations are singular at load factor {:.6g}, where it begins: something can "
                      "move without resistance",
                      factor_));
    const double response = step_.length(b);
    if (response > runaway && step_.runs_loose(b))
      throw ComputationError(fmt::format("static path: nothing holds {} against its load, at load factor {:.6g}",
                                         moves_most(system_, b, state_), factor_));
    if (!(response > resolved))
      throw ComputationError(
          "static path: nothing moves with the load factor: there are no loads that do work, or the analyses before "
          "have brought about all of them");
    // The distance from the end changes by `closing` per unit of load factor.
    const double part = 1e-6 / response;
    PathTrial trial{part * b, factor_ + part, state_};
    step_.place(state_, trial);
    const double closing = (end_.gap(trial.state, trial.factor) - gap_) / part;
    double way = std::abs(gap_ / closing);  // distance from the end in load factors
    if (!std::isfinite(way)) way = factor_ == 1 ? 1 : std::abs(1 - factor_);
    const bool towards_end = factor_ != 0 || path_.end.load_factor;
    const double sign = towards_end && closing * gap_ > 0 ? -1 : 1;
    const double steps = path_.steps > 0 ? path_.steps : 20;
    first_arc_ = std::min(response * way / steps, longest_arc / 2);
    most_arc_ = path_.steps > 0 ? std::min(4 * first_arc_, longest_arc) : longest_arc;
    arc_ = first_arc_;
    tangent_ = {sign / response * b, sign / response};
    going_ = sign;
  }

  bool correct(const PathCondition& condition, double arc) {
    if (!step_.correct(state_, condition, 2 * arc, trial_)) {
      why_ = step_.why();
      return false;
    }
    const double cosine = step_.product(trial_.delta, tangent_.direction) / step_.length(trial_.delta);
    if (cosine >= sharpest_bend) return true;
    why_ = fmt::format("the path bends by {:.0f} degrees at load factor {:.6g}", std::acos(cosine) * 180 / M_PI,
                       trial_.factor);
    return false;
  }

  /// Returns the tangent, oriented along the step that led to the trial. If the tangent matrix is singular, the
  /// direction of the step is kept.
  Tangent tangent_at(const PathTrial& trial) {
    VectorX b;
    if (step_.response(trial.state, trial.factor, b))
      if (const double response = step_.length(b); std::isfinite(response) && response > 0) {
        const double sign = step_.product(trial.delta, b) < 0 ? -1 : 1;
        return {sign / response * b, sign / response};
      }
    return {trial.delta / step_.length(trial.delta), 0};
  }

  /// Moves the trial to the point of the path at an arc from the base, in the direction of another one.
  bool correct_at(double arc, const PathTrial& far, double length) {
    trial_.delta = arc / length * far.delta;
    trial_.factor = factor_ + arc / length * (far.factor - factor_);
    return correct(ArcCondition(step_, arc), arc);
  }

  /// Moves the trial to the point between the base and the trial at which the slope of the load factor changes its
  /// sign. This is a zero, or a kink at which the slope jumps. @returns whether it was found
  bool locate_limit(Tangent& after, double& length) {
    constexpr int most = 60;
    constexpr double accurate = 1e-12, kink = 1e-10;  // relative tolerances of the load factor, and of arc to step
    const PathTrial far = trial_;
    const double size = std::max(std::abs(far.factor), std::abs(factor_)) + std::abs(tangent_.slope) * length;
    // Just after a limit point the slope is nearly zero and inaccurate. The opposite of the slope at the far end takes
    // its place.
    RootBracket bracket(0, at_limit_ ? -after.slope : tangent_.slope, length, after.slope);
    for (int k = 0; k < most; ++k) {
      const double arc = bracket.interpolated();
      if (!correct_at(arc, far, length)) return false;
      const Tangent here = tangent_at(trial_);
      const double curvature = std::abs(bracket.slope());
      if (here.slope * here.slope <= 2 * curvature * accurate * size || bracket.width() < kink * length) {
        trial_.iterations += far.iterations;
        after = here;
        length = arc;
        return true;
      }
      bracket.replace(here.slope * going_ > 0, arc, here.slope);
    }
    why_ = fmt::format("the limit point near load factor {:.6g} was not found", trial_.factor);
    return false;
  }

  /// Returns the first load factor to stop at before the trial.
  std::optional<double> next_stop() const {
    const std::vector<double>& stops = path_.stops;
    if (trial_.factor > factor_) {
      const auto above = std::upper_bound(stops.begin(), stops.end(), factor_);
      if (above != stops.end() && *above <= trial_.factor) return *above;
    } else if (const auto above = std::lower_bound(stops.begin(), stops.end(), factor_);
               above != stops.begin() && *std::prev(above) >= trial_.factor) {
      return *std::prev(above);
    }
    return {};
  }

  /// Moves the trial back to a condition that is met between the base and the trial, first to about this fraction of
  /// the distance.
  bool meet(EndCondition& condition, double part, double length) {
    trial_.delta *= part;
    const std::optional<double> factor = condition.load_factor();
    trial_.factor = factor.value_or(factor_ + part * (trial_.factor - factor_));
    condition.set_base(state_);
    if (!correct(condition, length)) return false;
    if (factor) trial_.factor = *factor;
    return true;
  }

  double softest(const PathTrial& trial, std::string* motion = nullptr) {
    const auto mode = stability_.softest(trial.state, ramp_.environment(trial.factor));
    if (mode && motion) *motion = stability_.describe(*mode);
    return mode ? mode->stiffness : 0;
  }

  /// Locates the point between the base and the trial, an arc `length` away, at which the number of unstable motions
  /// changes. It is the zero of the smallest stiffness within the bracket of the counts. The trial is not changed.
  CriticalPoint locate_bifurcation(int after, double length) {
    constexpr int most = 40;
    constexpr double accurate = 1e-7;
    const PathTrial far = trial_;
    CriticalPoint point;
    point.before = *unstable_;
    point.after = after;
    PathTrial near{VectorX::Zero(far.delta.size()), factor_, state_};
    const double k_near = softest(near), k_far = softest(far);
    RootBracket bracket(0, k_near, length, k_far);
    point.factor = factor_;
    for (int i = 0; i < most && bracket.width() > accurate * length; ++i) {
      const double arc = bracket.next(0.25 * accurate * length);
      std::optional<int> here;
      if (correct_at(arc, far, length)) here = stability_.count(trial_.state, ramp_.environment(trial_.factor));
      point.factor = trial_.factor;
      if (!here) break;  // the matrix is singular, or nearly: the point is found
      near = trial_;
      bracket.replace(*here == point.before, arc, softest(trial_));
    }
    softest(near, &point.motion);
    trial_ = far;
    return point;
  }

  /// Determines stability at the trial before it is accepted.
  void judge(bool limit, double length, PathPoint& point) {
    if (limit) {
      ++limits_;
      return;
    }
    point.unstable = stability_.count(trial_.state, ramp_.environment(trial_.factor));
    // A limit point also changes the number of unstable motions, and is not a bifurcation.
    if (unstable_ && point.unstable && limits_ == 0 && *point.unstable != *unstable_)
      point.bifurcation = locate_bifurcation(*point.unstable, length);
    unstable_ = point.unstable;
    limits_ = 0;
  }

  void refuse() {
    arc_ /= 2;
    if (arc_ < least_part * first_arc_)
      throw ComputationError(
          fmt::format("static path: no further point found beyond load factor {:.6g} (step {:.2g} of "
                      "the mechanism's size): {}",
                      factor_, 2 * arc_, why_));
  }

  PathPoint accept(double gap, bool limit, const Tangent& after, double length) {
    PathPoint point;
    judge(limit, length, point);
    const Environment loaded = ramp_.environment(trial_.factor);
    try {
      check_set_aside(system_, loaded, trial_.state);
      system_.accept(trial_.state, loaded);
    } catch (const ComputationError& error) {
      throw ComputationError(
          fmt::format("static path: the equilibrium at load factor {:.6g} is refused: {}; largest residual: {}",
                      trial_.factor, error.what(), step_.worst()));
    }
    state_ = trial_.state;
    factor_ = trial_.factor;
    gap_ = gap;
    tangent_ = after;
    at_limit_ = limit;
    going_ = limit ? -going_ : after.slope < 0 ? -1 : 1;
    // A step that ends at a limit point gives no reason to change the arc.
    if (!limit) arc_ = length * std::clamp(std::sqrt(easy_iterations / std::max(1, trial_.iterations)), 0.5, 2.0);
    travelled_ += length;
    // If all its initial positions are at one point, the size of a mechanism is the length of the path so far.
    const double longest =
        drawn_in_a_point_ && path_.steps == 0 ? std::max(most_arc_, longest_arc * travelled_) : most_arc_;
    arc_ = std::min(arc_, longest);
    point.load_factor = factor_;
    point.iterations = trial_.iterations;
    point.limit = limit;
    point.done = std::clamp(1 - std::abs(gap) / whole_, 0.0, 1.0);
    return point;
  }

  const LoadRamp& ramp_;
  const System& system_;
  const ContinuationOptions& path_;
  State& state_;
  double factor_;
  PathStep step_;
  Stability stability_;
  EndCondition end_;
  double gap_, whole_;
  bool drawn_in_a_point_;
  double travelled_ = 0;  ///< length of the path so far
  double first_arc_ = 0, most_arc_ = 0, arc_ = 0;
  Tangent tangent_;
  double going_ = 1;  ///< sign of the load factor's slope after the last point
  bool at_limit_ = false;
  PathTrial trial_;
  std::optional<int> unstable_;  ///< number of motions of negative stiffness at the last point that is no limit point
  int limits_ = 0;               ///< number of limit points since then
  std::string why_;
};

}  // namespace

Loaded follow_by_continuation(const System& system, const Environment& environment, const Loaded& start,
                              const ContinuationOptions& options, const NewtonOptions& newton, State& state,
                              const std::function<void(const State&, const PathPoint&)>& record) {
  const LoadRamp ramp(system, environment, start);
  ramp.set_off(state);
  begin_states(system, ramp.environment(1), state);
  Path path(ramp, options, newton, state);
  for (int points = 0; !path.ended(); ++points) {
    if (points == options.most_points)
      throw ComputationError(
          fmt::format("static path: its end was not met in {}; the last one stands at load factor {:.6g}, {}",
                      counted(points, "point"), path.factor(), path.describe_end()));
    const PathPoint point = path.advance();
    if (record) record(state, point);
  }
  return {path.factor(), ramp.motion(path.factor())};
}

}  // namespace bielle::mechanism
