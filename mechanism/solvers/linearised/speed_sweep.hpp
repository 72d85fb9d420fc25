// Modes over a speed: tracked from value to value of the swept parameter, with critical speeds, crossings and veerings.
//
// Between two values at which shapes have changed too much to be identified, or frequencies have changed their order,
// further values are inserted, down to a sixty-fourth of the distance. Frequencies that change their order with
// constant shapes have crossed; frequencies that approach each other, turn away and exchange their shapes have veered
// (N. C. Perkins, C. D. Mote, J. Sound Vib. 106 (1986) 451): there each number continues along its line, and denotes
// another shape afterwards. Shapes that are unlike those at rest however small the speed is are followed as spaces.
#pragma once

#include <functional>
#include <vector>

#include "mechanism/solvers/linearised/mode_tracking.hpp"

namespace bielle::mechanism {

struct SweepSample {
  ModeSample modes;
  double speed = 0;  ///< speed of the shaft [rad/s]
};

struct SweepPoint {
  double value = 0;   ///< value of the swept parameter
  double speed = 0;   ///< [rad/s]
  bool given = true;  ///< whether it was requested, not inserted
  std::vector<TrackedMode> tracks;
};

/// A speed at which the damped frequency of a mode is a multiple of the speed.
struct CriticalSpeed {
  int mode = 0;      ///< index from 0
  double order = 1;  ///< the multiple
  double value = 0, speed = 0;
  double frequency = 0;  ///< damped frequency [Hz]
  double damping_ratio = 0, whirl = 0;
};

/// A place at which two frequencies come together.
struct ModeMeeting {
  int first = 0, second = 0;
  bool veering = false;  ///< whether they turn away and exchange their shapes; otherwise they cross
  double value = 0, speed = 0;
  double frequency = 0;  ///< mean of the two [Hz]
  double gap = 0;        ///< distance between them [Hz]; 0 for crossings
};

/// A mode whose track is uncertain between two values, or lost.
struct UncertainTrack {
  int mode = 0;
  bool lost = false;
  double from = 0, to = 0;  ///< range of values
  double correlation = 0;
};

struct SweptModes {
  std::vector<SweepPoint> points;  ///< ascending by value, including inserted ones
  std::vector<CriticalSpeed> critical;
  std::vector<ModeMeeting> meetings;
  std::vector<UncertainTrack> uncertain;
  int solved = 0;  ///< number of states at which modes were computed
};

/// It is thrown by a solution to end the sweep before it.
struct SweepEnded {};

class SpeedSweep {
 public:
  /// Number of modes that are computed at first besides those that are tracked.
  static constexpr int beyond = 8;
  /// Computes modes at a value of the swept parameter: at least `count` of the slowest, of any kind, or all.
  using Solve = std::function<SweepSample(double value, int count)>;
  /// @param values  ascending, at least two @param modes  number of modes to track @param orders  multiples of the
  ///                speed
  SpeedSweep(Solve solve, std::vector<double> values, int modes, std::vector<double> orders)
      : solve_(std::move(solve)), values_(std::move(values)), modes_(modes), orders_(std::move(orders)) {}
  /// If a solution throws SweepEnded, the points before it are returned; there are none if it is the first.
  /// @param stops  called after each value; true ends the sweep there
  SweptModes run(const std::function<bool()>& stops = {});

 private:
  SweepSample sample_at(double value);
  SweepPoint begin();
  SweepPoint followed(const SweepPoint& from, double value);
  SweepPoint followed_from_rest(const SweepPoint& from, const SweepPoint& to);
  bool follow_at_once(const SweepPoint& from, const SweepPoint& to);
  void go_to(double value);
  void advance(const SweepPoint& from, SweepPoint to, int depth);
  void accept(const SweepPoint& from, SweepPoint to);
  void find_critical(const SweepPoint& a, const SweepPoint& b);
  void locate(SweepPoint a, SweepPoint b, std::size_t mode, double order);
  void find_meetings();
  void find_crossings(std::size_t i, std::size_t j);
  void find_veerings(std::size_t i, std::size_t j);

  Solve solve_;
  std::vector<double> values_;
  int modes_;
  std::vector<double> orders_;
  int count_ = 0;  ///< number of requested modes
  LinearisedEquations::Sparse M_;
  SweptModes result_;
};

}  // namespace bielle::mechanism
