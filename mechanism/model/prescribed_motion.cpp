#include "mechanism/model/prescribed_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Velocity and displacement, with the range of the sampled acceleration.
struct Travel {
  double velocity = 0, displacement = 0;
  double lowest = 0, highest = 0;  ///< smallest and largest sampled acceleration
};

/// Changes due to an acceleration over [from, to]: integrals of a and of (to - s) a, by five points (exact to degree
/// nine).
Travel gained(const Expression& acceleration, double from, double to) {
  static constexpr std::array<double, 5> point{-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                               0.9061798459386640};
  static constexpr std::array<double, 5> weight{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                                0.4786286704993665, 0.2369268850561891};
  const double half = 0.5 * (to - from), middle = 0.5 * (from + to);
  Travel sum;
  sum.lowest = std::numeric_limits<double>::infinity();
  sum.highest = -sum.lowest;
  for (std::size_t k = 0; k < point.size(); ++k) {
    const double value = acceleration(middle + half * point[k]), a = half * weight[k] * value;
    sum.lowest = std::min(sum.lowest, value);
    sum.highest = std::max(sum.highest, value);
    sum.velocity += a;
    sum.displacement += half * (1 - point[k]) * a;
  }
  return sum;
}

}  // namespace

/// The pieces computed so far: created from 0 up to the largest time requested, in an order that does not depend on the
/// caller.
class PrescribedMotion::Integral {
 public:
  Integral(const Expression& acceleration, double velocity, double displacement)
      : acceleration_(acceleration), breaks_(acceleration.break_points()) {
    pieces_.push_back({0, {velocity, displacement}});
  }

  Travel at(double t) {
    Piece piece;
    {
      const std::lock_guard lock(mutex_);
      while (end_ < t - 1e-9 * (1 + t)) extend();  // a table may end at t, up to rounding
      const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                                          [](double time, const Piece& each) { return time < each.begin; });
      piece = after == pieces_.begin() ? pieces_.front() : *(after - 1);
    }
    return moved(piece, t);
  }

 private:
  struct Piece {
    double begin = 0;
    Travel start;
  };

  Travel moved(const Piece& piece, double t) const {
    if (t == piece.begin) return piece.start;
    const Travel more = gained(acceleration_, piece.begin, t);
    return {piece.start.velocity + more.velocity,
            piece.start.displacement + piece.start.velocity * (t - piece.begin) + more.displacement};
  }

  /// Adds one more piece.
  void extend() {
    const double begin = end_;
    constexpr std::size_t most = 10'000'000;
    if (pieces_.size() > most)
      throw ComputationError(
          fmt::format("the acceleration {} varies too fast to be integrated: {} pieces until t = {:.6g} s",
                      acceleration_.text(), most, begin));
    if (begin > 0) pieces_.push_back({begin, moved(pieces_.back(), begin)});
    const double longest = std::max(1e-3, begin / 200), shortest = 1e-9 * (1 + begin);
    double width = std::min(2 * width_, longest);
    const auto next = std::upper_bound(breaks_.begin(), breaks_.end(), begin);
    if (next != breaks_.end()) width = std::min(width, *next - begin);
    while (width > shortest && !settled(begin, width)) width /= 2;
    width_ = width;
    end_ = next != breaks_.end() && begin + width >= *next ? *next : begin + width;
  }

  /// Returns whether the sum of both halves agrees with the whole piece.
  bool settled(double begin, double width) const {
    const double middle = begin + 0.5 * width, end = begin + width;
    const Travel whole = gained(acceleration_, begin, end), first = gained(acceleration_, begin, middle),
                 second = gained(acceleration_, middle, end);
    const double lowest = std::min(first.lowest, second.lowest), highest = std::max(first.highest, second.highest);
    const double size = std::max(std::abs(lowest), std::abs(highest)) * width;
    // Times are rounded, and accelerations at these times have corresponding errors.
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * end * (highest - lowest);
    return std::abs(first.velocity + second.velocity - whole.velocity) <= 1e-13 * size + rounding;
  }

  Expression acceleration_;
  std::vector<double> breaks_;
  std::mutex mutex_;
  std::vector<Piece> pieces_;
  double end_ = 0, width_ = 1e-3;
};

PrescribedMotion PrescribedMotion::of_acceleration(Expression acceleration, double velocity, double displacement) {
  PrescribedMotion motion(std::move(acceleration));
  motion.integral_ = std::make_shared<Integral>(motion.function_, velocity, displacement);
  return motion;
}

double PrescribedMotion::operator()(double t) const { return integral_ ? integral_->at(t).displacement : function_(t); }

double PrescribedMotion::derivative(double t, int order) const {
  if (!integral_) return function_.derivative(t, order);
  return order == 1 ? integral_->at(t).velocity : function_(t);
}

}  // namespace bielle::mechanism
