// A body that a constant force pushes against a stop of spring and damper, which throws it back repeatedly: closed
// form.
//
// Free: q'' = f. In contact, p = q - upper: p'' = f - 2 delta p' - omega^2 p, as long as the stop pushes, omega^2 p + 2
// delta p' > 0; after that q'' = f until p = 0, where contact ends. All quantities are per unit of mass.
#pragma once

#include <cmath>
#include <vector>

namespace bielle::test {

class Bounce {
 public:
  /// From rest at q = 0. @param f  acceleration by the constant force @param omega, delta constants of the stop:
  /// sqrt(k/m), d/2m
  Bounce(double upper, double f, double omega, double delta) : upper_(upper), f_(f), omega_(omega), delta_(delta) {
    pieces_.push_back({Kind::free, 0, 0, 0});
  }
  struct Point {
    double q, v, stop;  ///< stop: its force on the coordinate, per unit of mass
  };
  Point at(double time) {
    extend(time);
    std::size_t k = pieces_.size() - 1;
    while (pieces_[k].begin > time) --k;
    return point(pieces_[k], time - pieces_[k].begin);
  }
  /// Times at which contact begins and ends, one after the other, up to a time.
  std::vector<double> events(double until) {
    extend(until);
    std::vector<double> times;
    for (std::size_t k = 1; k < pieces_.size(); ++k)
      if (pieces_[k].kind != Kind::let_go && pieces_[k].begin <= until) times.push_back(pieces_[k].begin);
    return times;
  }

 private:
  enum class Kind { free, contact, let_go };
  struct Piece {
    Kind kind;
    double begin, q, v;  ///< at its begin
  };
  Point point(const Piece& piece, double s) const {
    if (piece.kind != Kind::contact) return {piece.q + piece.v * s + f_ * s * s / 2, piece.v + f_ * s, 0};
    const double w = std::sqrt(omega_ * omega_ - delta_ * delta_), rest = f_ / (omega_ * omega_);
    const double a = piece.q - upper_ - rest, b = (piece.v + delta_ * a) / w;
    const double e = std::exp(-delta_ * s), c = std::cos(w * s), n = std::sin(w * s);
    const double p = rest + e * (a * c + b * n);
    const double v = e * ((b * w - delta_ * a) * c - (a * w + delta_ * b) * n);
    return {upper_ + p, v, -(omega_ * omega_ * p + 2 * delta_ * v)};
  }
  /// Returns the first zero of a function past `from`, negative there. @param step  below the distance of its zeros
  template <class Function>
  static double zero(const Function& g, double from, double step) {
    double low = from, high = from + step;
    while (g(high) < 0) low = high, high += step;
    for (int k = 0; k < 200; ++k) (g(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
    return high;
  }
  void extend(double time) {
    while (pieces_.back().begin <= time) {
      const Piece last = pieces_.back();
      const double small = 0.01 / omega_;
      double s = 0;
      Kind next = Kind::contact;
      if (last.kind == Kind::free) {
        const double down = upper_ - last.q;  // down = v s + f s^2/2, the later zero
        s = (-last.v + std::sqrt(last.v * last.v + 2 * f_ * down)) / f_;
      } else if (last.kind == Kind::contact) {
        next = delta_ > 0 ? Kind::let_go : Kind::free;
        s = zero([&](double at) { return point(last, at).stop; }, small / 10, small);
      } else {
        next = Kind::free;
        s = zero([&](double at) { return upper_ - point(last, at).q; }, 0, small);
      }
      const Point end = point(last, s);
      // The places of contact's begin and end are known exactly.
      pieces_.push_back({next, last.begin + s, next == Kind::let_go ? end.q : upper_, end.v});
    }
  }
  double upper_, f_, omega_, delta_;
  std::vector<Piece> pieces_;
};

}  // namespace bielle::test
