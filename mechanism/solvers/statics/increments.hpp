// The increments of the load factor that a static analysis makes.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace bielle::mechanism {

/// Chooses the next fraction of the interval from the first load factor to the full load.
class Increments {
 public:
  /// @param count  number of equal parts; 0: chosen by the convergence of Newton's method
  /// @param stops  fractions at which an increment must end, ascending
  Increments(int count, std::vector<double> stops)
      : grid_(count > 0 ? 1.0 / count : 0),
        part_(count > 0 ? grid_ : 0.1),
        least_(part_ / 1024),
        stops_(std::move(stops)) {}

  bool ended() const { return made_ == 1; }
  double made() const { return made_; }
  /// Returns the end of the next increment: at most the next point of the grid.
  double end() const {
    constexpr double rounding = 1e-9;
    double end = made_ + part_;
    if (grid_ > 0) end = std::min(end, grid_ * (std::floor(made_ / grid_ + rounding) + 1));
    if (end > 1 - rounding) end = 1;
    const auto stop = std::upper_bound(stops_.begin(), stops_.end(), made_);
    return stop != stops_.end() && *stop < end * (1 + rounding) ? *stop : end;
  }
  /// Returns whether increments have been halved so often that another method is tried.
  bool stuck() const { return part_ <= 16 * least_; }
  /// @returns false if they have become too small
  bool halve() {
    part_ = (end() - made_) / 2;
    calm_ = 0;
    return part_ >= least_;
  }
  /// @param followed  whether it was too large to be checked by its ends
  void accept(int iterations, bool followed) {
    made_ = end();
    ++calm_;
    if (grid_ > 0) {
      if (iterations <= easy || calm_ > 1) part_ = std::min(grid_, 2 * part_);
    } else {
      const double ease = followed ? 0.5 : static_cast<double>(easy) / std::max(1, iterations);
      part_ = std::min(1.0, part_ * std::clamp(ease, 0.5, 2.0));
    }
  }

 private:
  static constexpr int easy = 6;  // iterations of Newton's method
  double grid_, part_, least_, made_ = 0;
  std::vector<double> stops_;
  int calm_ = 0;  ///< number of increments since the last rejected one
};

/// Returns load factors after the first one as fractions of the interval from there to the full load.
inline std::vector<double> parts_of_the_way(const std::vector<double>& factors, double begin) {
  std::vector<double> parts;
  for (const double factor : factors)
    if (factor > begin && factor <= 1) parts.push_back(factor == 1 ? 1 : (factor - begin) / (1 - begin));
  return parts;
}

}  // namespace bielle::mechanism
