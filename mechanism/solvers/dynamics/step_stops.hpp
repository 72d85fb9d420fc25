// The times at which the steps of a motion have to end: the grid of fixed steps, kinks, instants of samplers, jumps
// that delays bring back, and the end.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "mechanism/model/sampler.hpp"

namespace bielle::mechanism {

struct StepOptions {
  double size = 0;                                           ///< fixed size, or size of the first step [s]
  double tolerance = 0;                                      ///< tolerance of the local error; 0: fixed steps
  double largest = std::numeric_limits<double>::infinity();  ///< largest step [s], adaptive steps only
  /// Times at which forces or prescribed motions have kinks. Times outside the interval are ignored.
  std::vector<double> break_points;
};

class StepStops {
 public:
  /// @param begin  origin of the grid of fixed steps [s] @param end  the last stop [s]
  StepStops(double begin, double end, const StepOptions& options, std::vector<Sampler::Instants> instants);

  /// Moves on to the first stop after the given time.
  void advance(double time);
  /// Takes account of a kink after the present time that has become known during the motion.
  void heed(double kink);
  /// Returns the latest time that is equal to the given one.
  double just_after(double time) const { return time + rounding(time); }
  double time() const { return stop_; }                              ///< the present stop [s]
  bool at_kink() const { return at_kink_; }                          ///< whether it is a kink
  bool on_grid() const { return steps_ == 0 || stop_ == grid(k_); }  ///< whether it is a time of the grid
  double step_size() const { return size_; }                         ///< step size of the grid; 0: no grid

 private:
  /// Times that differ by less are equal. The distance is smaller than the one that separates both sides of a kink.
  double rounding(double time) const;
  /// Times are computed from the number of steps, not summed: the last step ends exactly at the end.
  double grid(long k) const { return k >= steps_ ? end_ : begin_ + static_cast<double>(k) * size_; }
  double begin_, end_, rounding_, size_ = 0, stop_ = 0;
  long steps_ = 0, k_ = 1;  ///< number of steps of the grid, and next; 0: no grid
  std::vector<double> kinks_;
  std::vector<Sampler::Instants> instants_;
  std::size_t kink_ = 0;
  bool at_kink_ = false;
};

}  // namespace bielle::mechanism
