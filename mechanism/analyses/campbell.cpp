#include "mechanism/analyses/campbell.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "mechanism/analyses/mode_names.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/session/interrupted.hpp"
#include "mechanism/solvers/linearised/whirl.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/formula/expression.hpp"

namespace bielle::mechanism {
namespace {

/// Computes the states of a rotor at values of the swept parameter.
class CampbellStates {
 public:
  CampbellStates(Session& session, const CampbellOptions& options) : session_(session), options_(options) {}

  /// Axes and setting are those of the last value: if any motion is steady in the axes, this one is.
  void begin(Campbell& found) {
    const double last = options_.values.back();
    found_ = &found;
    const bool behind_joint = !options_.joint.empty();
    const int count = behind_joint ? options_.modes + SpeedSweep::beyond : 1;
    found.gathered = with_modes(last, count, [&](const System& system, const ModesReport& report) {
      static_cast<LinearisedSetting&>(found) = report;
      if (behind_joint) {
        harmonics_ = std::max(1, report.turning->harmonics);
        found.turning->unresolved = 0;
        last_ = {count, sample_of(last, system, report, true)};
        return;
      }
      // Frequencies of whirl are taken in inertial axes if the motion is steady in these to a thousandth.
      const bool inertial = report.steadiness && report.steadiness->steady_in(ModeAxes::inertial);
      axes_ = inertial ? ModeAxes::inertial : report.axes;
      axis_ = options_.axis.isZero(0) ? fastest(report.about.state, last) : Vector3(options_.axis);
      check_turns(report.about.state, last);
      found.axes = *axes_;
    });
    found.axis = axis_;
  }

  SweepSample sample(double value, int count) {
    count_ = count;
    if (value == options_.values.back() && last_.count >= count) return last_.sample;
    SweepSample sample;
    with_modes(value, count, [&](const System& system, const ModesReport& report) {
      sample = sample_of(value, system, report, is_end(value));
    });
    return sample;
  }

  /// Names the tracked modes as the modes of the last point are named; modes that are lost there, as those of the
  /// first.
  void name_modes() {
    const SweepPoint &first = found_->swept.points.front(), &last = found_->swept.points.back();
    if (last.tracks.empty()) return;
    std::vector<std::string>& names = found_->names;
    names = names_at(last);
    if (std::all_of(last.tracks.begin(), last.tracks.end(), [](const TrackedMode& track) { return track.found; }))
      return;
    const std::vector<std::string> before = names_at(first);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!last.tracks[i].found && !before[i].empty()) names[i] = before[i] + ", lost";
  }

 private:
  struct Sampled {
    int count = 0;  ///< number of modes that were asked for; 0: there is no sample
    SweepSample sample;
  };
  struct NamedModes {
    std::vector<Mode> modes;
    std::vector<std::string> names;
  };

  bool is_end(double value) const { return value == options_.values.front() || value == options_.values.back(); }

  SweepSample sample_of(double value, const System& system, const ModesReport& report, bool named) {
    SweepSample sample;
    const State& state = report.about.state;
    if (report.turning) note_harmonics(*report.turning);
    sample.speed = report.turning ? report.turning->rate : speed(state);
    sample.modes.M = report.equations->M;
    sample.modes.all = report.found.all;
    for (std::size_t k = 0; k < report.found.modes.size(); ++k) {
      const Mode& mode = report.found.modes[k];
      if (!(mode.s.imag() > 0)) continue;
      sample.modes.modes.push_back(mode);
      if (report.turning) {
        sample.modes.whirl.push_back(report.turning_whirl(system, k));
        continue;
      }
      const auto whirl = whirl_of(system, state, sample.modes.M, mode, axis_);
      // Forward whirl has the sense of the speed; without rotation there is neither forward nor backward whirl.
      sample.modes.whirl.push_back(whirl && sample.speed != 0 ? std::copysign(1, sample.speed) * *whirl : NAN);
    }
    if (found_->standing.empty()) found_->standing = report.standing;
    if (report.steadiness && !report.steadiness->steady_in(*axes_) &&
        std::count(found_->unsteady.begin(), found_->unsteady.end(), value) == 0)
      found_->unsteady.push_back(value);
    if (named) named_[value] = {report.found.modes, full_names(describe_modes(system, report))};
    return sample;
  }

  /// Returns the mode with the exponent of a track, or its conjugate, that is not taken.
  static std::optional<std::size_t> mode_of(const TrackedMode& track, const std::vector<Mode>& modes,
                                            const std::vector<char>& taken) {
    constexpr double same = 1e-6;
    std::optional<std::size_t> nearest;
    double least = same * std::abs(track.s);
    for (std::size_t k = 0; track.found && k < modes.size(); ++k) {
      const double gap = std::min(std::abs(modes[k].s - track.s), std::abs(std::conj(modes[k].s) - track.s));
      if (taken[k] != 0 || gap > least) continue;
      least = gap;
      nearest = k;
    }
    return nearest;
  }

  /// Returns the names of the tracked modes among all modes of a point.
  std::vector<std::string> names_at(const SweepPoint& point) {
    if (named_.count(point.value) == 0)  // the sweep ended early
      with_modes(
          point.value, count_,
          [&](const System& system, const ModesReport& report) { sample_of(point.value, system, report, true); }, true);
    const NamedModes& all = named_.at(point.value);
    std::vector<std::string> names(point.tracks.size());
    std::vector<char> taken(all.names.size(), 0);
    for (std::size_t i = 0; i < point.tracks.size(); ++i) {
      const std::optional<std::size_t> mode = mode_of(point.tracks[i], all.modes, taken);
      if (!mode) continue;
      taken[*mode] = 1;
      names[i] = all.names[*mode];
    }
    return names;
  }

  /// Keeps the largest number of harmonics, the largest change by one more, and rates at which they do not suffice.
  void note_harmonics(const LinearisedSetting::Turning& turning) {
    LinearisedSetting::Turning& whole = *found_->turning;
    if (turning.unresolved > 0) whole.unresolved_at.insert(turning.rate);
    whole.periodicity = std::max(whole.periodicity, turning.periodicity);
    whole.harmonics = std::max(whole.harmonics, turning.harmonics);
    whole.change = std::max(whole.change, turning.change);
    if (turning.displacement > whole.displacement) {
      whole.displacement = turning.displacement;
      whole.moved = turning.moved;
    }
    whole.rotation = std::max(whole.rotation, turning.rotation);
    whole.orbit_harmonics = std::max(whole.orbit_harmonics, turning.orbit_harmonics);
  }

  /// @returns lines of the components of another model; empty for that of the session, which collects its own
  template <class Use>
  std::string with_modes(double value, int count, const Use& use, bool energies = false) const {
    ModesOptions options;
    options.search.count = count;
    options.axes = axes_;
    options.harmonics = harmonics_;
    options.energies = energies || is_end(value);
    if (options_.parameter.empty()) {
      set_rotation(session_.model(), value, options);
      use(session_.system(), compute_modes(session_, options));
      return {};
    }
    Model model = made(value);
    if (options_.rotation) set_rotation(model, rate_of(model), options);
    try {
      Session other(std::move(model));
      other.begin_analysis("campbell");
      use(other.system(), compute_modes(other, options));
      return other.gathered();
    } catch (const ComputationError& error) {
      throw ComputationError(fmt::format("{} = {:.9g}: {}", options_.parameter, value, error.what()));
    }
  }

  Model made(double value) const {
    try {
      return options_.maker(options_.parameter, value);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{} (where {} = {:.9g})", error.what(), options_.parameter, value));
    }
  }

  void set_rotation(const Model& model, double rate, ModesOptions& options) const {
    if (!options_.joint.empty()) {
      options.rotation = SteadyRotation{};
      options.rotation->joint = model.members_of({Section::joints, options_.joint}).front();
      options.rotation->rate = rate;
      options.rotation->mean = options_.mean;
      return;
    }
    if (rate != 0) options.rotation = SteadyRotation{rate * options_.axis, options_.through};
  }

  double rate_of(const Model& model) const {
    const std::string& formula = options_.rate.empty() ? options_.parameter : options_.rate;
    return Expression(formula, {}, model.parameters)({});
  }

  void check_turns(const State& state, double value) const {
    if (options_.node < 0 || value == 0) return;
    const Vector3 rate = omega(state.nodes[static_cast<std::size_t>(options_.node)]);
    constexpr double rounding = 1e-12;
    if (std::abs(rate.dot(axis_)) <= rounding * std::abs(most(state)))
      throw InputError(fmt::format(
          "`node`: '{}' does not turn about the axis at the last value, {:.6g}: its angular velocity is the "
          "speed that frequencies are compared with",
          session_.system().model().nodes()[static_cast<std::size_t>(options_.node)].name, value));
  }

  static Vector3 omega(const NodeState& node) { return node.R * node.Omega; }

  Vector3 fastest(const State& state, double value) const {
    Vector3 most = Vector3::Zero();
    for (const NodeState& node : state.nodes)
      if (omega(node).norm() > most.norm()) most = omega(node);
    if (most.isZero(0))
      throw InputError(
          fmt::format("nothing turns where {} = {:.6g}: the parameter has to set a speed (angular "
                      "velocities of nodes, rates of joints), or `rotation` turns everything",
                      options_.parameter, value));
    return most.normalized();
  }

  double speed(const State& state) const {
    if (options_.node >= 0) return omega(state.nodes[static_cast<std::size_t>(options_.node)]).dot(axis_);
    return most(state);
  }

  /// Component about the axis of the largest angular velocity of a node [rad/s].
  double most(const State& state) const {
    double most = 0;
    for (const NodeState& node : state.nodes)
      if (const double rate = omega(node).dot(axis_); std::abs(rate) > std::abs(most) * (1 + 1e-9)) most = rate;
    return most;
  }

  Session& session_;
  const CampbellOptions& options_;
  std::optional<ModeAxes> axes_;
  int harmonics_ = 1;  ///< number that is tried first at each value: that of the last one
  Vector3 axis_ = Vector3::Zero();
  int count_ = 0;                       ///< number of modes that were computed at the last state
  Sampled last_;                        ///< of the last value
  std::map<double, NamedModes> named_;  ///< at both ends of the sweep
  Campbell* found_ = nullptr;
};

}  // namespace

Campbell compute_campbell(Session& session, const CampbellOptions& options) {
  if (!options.parameter.empty() && !options.maker)
    throw InputError("a parameter can be swept only in models that were read from a file or a text");
  Campbell found;
  CampbellStates states(session, options);
  states.begin(found);
  SpeedSweep sweep(
      [&](double value, int count) {
        const double done = (value - options.values.front()) / (options.values.back() - options.values.front());
        if (Notes* notes = session.notes()) notes->progress(done, [=] { return fmt::format("{:.4g}", value); });
        try {
          session.call_back();
        } catch (const Interrupted&) {
          found.interrupted = true;
          throw SweepEnded();
        }
        return states.sample(value, count);
      },
      options.values, options.modes, options.orders);
  session.forget_stop();
  found.swept = sweep.run([&] { return session.stopping(); });
  if (found.swept.points.empty()) return found;
  states.name_modes();
  if (!found.unsteady.empty()) found.swept.critical.clear();  // frequencies of a moment are no frequencies of forces
  return found;
}

}  // namespace bielle::mechanism
