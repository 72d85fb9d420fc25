#include "mechanism/joints/flexible/journal_film.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "mechanism/joints/flexible/film_map.hpp"

namespace bielle::mechanism {
namespace {

using std::numbers::pi;
using Jet = AutoDiff<2, 1>;
struct FilmForce {
  Jet along = 0, across = 0;
};

/// Points and weights of Gauss quadrature over |s| < pi/2.
struct HalfCircle {
  static constexpr std::size_t count = 64;
  std::array<double, count> s, weight;
  HalfCircle() {
    for (std::size_t k = 0; k < count; ++k) {
      double x = std::cos(pi * (static_cast<double>(k) + 0.75) / (count + 0.5)), slope = 0;
      for (int iteration = 0; iteration < 8; ++iteration) {
        double P = 1, before = 0;
        for (std::size_t n = 1; n <= count; ++n) {
          const auto order = static_cast<double>(n);
          const double next = ((2 * order - 1) * x * P - (order - 1) * before) / order;
          before = P;
          P = next;
        }
        slope = count * (x * P - before) / (x * x - 1);
        x -= P / slope;
      }
      s[k] = 0.5 * pi * x;
      weight[k] = pi / ((1 - x * x) * slope * slope);
    }
  }
};

Jet thickness(const Jet& a, const Jet& d, double s) { return 1 - (std::cos(s) * a + std::sin(s) * d); }
Jet cubed(const Jet& h) { return compose(h, h.value * h.value * h.value, 3 * h.value * h.value); }

FilmForce short_film(const Jet& a, const Jet& d) {
  static const HalfCircle circle;
  FilmForce sum;
  for (std::size_t k = 0; k < HalfCircle::count; ++k) {
    const double s = circle.s[k], load = circle.weight[k] * std::cos(s);
    const Jet h = thickness(a, d, s);
    const Jet flow = compose(h, 1 / (h.value * h.value * h.value), -3 / (h.value * h.value * h.value * h.value));
    sum.along += load * std::cos(s) * flow;
    sum.across += load * std::sin(s) * flow;
  }
  return sum;
}

/// Solves (h^3 q')' - stiff h^3 q = -cos s with q = 0 at both ends, and integrates q [cos s, sin s].
FilmForce mode_of_film(const Jet& a, const Jet& d, double stiff) {
  constexpr int parts = 128;
  constexpr double step = pi / parts;
  std::array<Jet, parts> flow;  // h^3/step^2 between the points
  for (int k = 0; k < parts; ++k)
    flow[static_cast<std::size_t>(k)] = 1 / (step * step) * cubed(thickness(a, d, -0.5 * pi + (k + 0.5) * step));
  // Elimination of the tridiagonal equations: q_k = upper_k q_(k+1) + known_k.
  std::array<Jet, parts> upper, known;
  upper[0] = known[0] = 0.0;
  for (int k = 1; k < parts; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double s = -0.5 * pi + k * step;
    const Jet pivot = flow[i - 1] + flow[i] + stiff * cubed(thickness(a, d, s)) - flow[i - 1] * upper[i - 1];
    upper[i] = flow[i] / pivot;
    known[i] = (std::cos(s) + flow[i - 1] * known[i - 1]) / pivot;
  }
  FilmForce sum;
  Jet q = 0.0;
  for (int k = parts - 1; k > 0; --k) {
    const auto i = static_cast<std::size_t>(k);
    const double s = -0.5 * pi + k * step;
    q = upper[i] * q + known[i];
    sum.along += step * std::cos(s) * q;
    sum.across += step * std::sin(s) * q;
  }
  return sum;
}

}  // namespace

JournalFilm::JournalFilm(double slenderness, Cavitation cavitation)
    : slenderness_(slenderness),
      map_(slenderness > 0 && cavitation == Cavitation::reynolds ? FilmMap::of(slenderness) : nullptr) {}

// The pressure p = 6 mu |B|/c^3 sum a_m q_m(s) cos(kappa_m z), kappa_m = m pi/L, a_m = 4 (-1)^((m-1)/2)/(m pi), m odd,
// has (h^3 q')'/R^2 - kappa_m^2 h^3 q = -cos s. Its integral over z is a_m q_m 2 (-1)^((m-1)/2)/kappa_m: the share of
// W is 96/(pi m)^4 (kappa_m R)^2 times the integral of q_m/R^2.
JournalFilm::Shape JournalFilm::shape(double a_value, double d_value) const {
  const Jet a(a_value, Jet::Gradient(1, 0)), d(d_value, Jet::Gradient(0, 1));
  FilmForce film = short_film(a, d);
  if (slenderness_ > 0) {
    double rest = 1;
    FilmForce sum;
    const int modes = 3 + static_cast<int>(2 * slenderness_);  // modes beyond these have kappa R > 7
    for (int m = 1; m < 2 * modes; m += 2) {
      const double stiff = std::pow(0.5 * m * pi / slenderness_, 2), share = 96 / std::pow(m * pi, 4);
      const FilmForce mode = mode_of_film(a, d, stiff);
      rest -= share;
      sum.along += share * stiff * mode.along;
      sum.across += share * stiff * mode.across;
    }
    film = {sum.along + rest * film.along, sum.across + rest * film.across};
  }
  if (map_) {
    const std::array<Jet, 2> difference = map_->difference(a_value, d_value);
    const Jet square = film.along * film.along + film.across * film.across;
    const double size = std::sqrt(square.value);
    const Jet scale = compose(square, size, 0.5 / size);
    film.along += scale * difference[0];
    film.across += scale * difference[1];
  }
  Shape shape;
  shape.W << film.along.value, film.across.value;
  shape.gradient << film.along.gradient.transpose(), film.across.gradient.transpose();
  return shape;
}

}  // namespace bielle::mechanism
