#include "mechanism/joints/tyres/tyre_law.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

using Numbers = std::array<TyreNumber, tyre_variables>;

constexpr double release_time = 1e-3;  ///< T [s]

TyreNumber abs_of(const TyreNumber& x) { return x.value < 0 ? -x : x; }

/// Returns the length of (x, y), whose derivative is taken as zero at the origin.
TyreNumber length_of(const TyreNumber& x, const TyreNumber& y) {
  const double length = std::hypot(x.value, y.value);
  if (length == 0) return {};
  return compose(x, y, length, x.value / length, y.value / length);
}

/// rho/g(rho), which is 1 without slip, with its slope.
struct SlipRatio {
  double value, slope;
};

SlipRatio ratio_of_brush(double rho) {
  constexpr double sliding = 3;
  if (rho >= sliding) return {rho, 1};
  const double y = 1 / (1 - rho / 3 + rho * rho / 27);
  return {y, (1.0 / 3 - 2 * rho / 27) * y * y};
}

/// @param C,E  shape and curvature of the magic formula
SlipRatio ratio_of_formula(double rho, double C, double E) {
  constexpr double tiny = 1e-6;
  const double B = 1 / C, x = B * rho, X = x - E * (x - std::atan(x)), phi = std::atan(X);
  const double g = std::sin(C * phi);
  const double slope = std::cos(C * phi) * C / (1 + X * X) * B * (1 - E * x * x / (1 + x * x));
  if (rho < tiny) return {1, 0};
  return {rho / g, (g - rho * slope) / (g * g)};
}

/// Lambda = V rho/g(rho), rho = s/V. @param s  |C l v'|/(mu N) [m/s] @param V  |V_r| [m/s]
TyreNumber calc_decay(const TyreNumber& V, const TyreNumber& s, const TyreSlip& slip) {
  constexpr double all_slides = 1e9;
  const bool at_rest = !(s.value < all_slides * V.value);
  const double rho = at_rest ? all_slides : s.value / V.value;
  const SlipRatio y = slip.shape ? ratio_of_formula(rho, *slip.shape, slip.curvature) : ratio_of_brush(rho);
  if (at_rest) return compose(s, s.value * y.value / rho, y.value / rho);
  return compose(V, s, V.value * y.value, y.value - rho * y.slope, y.slope);
}

/// t/t_0 of the brush model. @param q  force over mu N
TyreNumber trail_factor(const TyreNumber& q) {
  if (q.value >= 1) return {};
  // d(p^3) = -dq, and p' = -1/(3 p^2), which is multiplied by p^3.
  const double p = std::cbrt(1 - q.value), sum = 1 + p + p * p;
  return compose(q, 3 * p * p * p / sum, -3 / sum + p * (1 + 2 * p) / (sum * sum));
}

/// b T = (1 - 1/q)^2 of a tread that the load does not hold.
TyreNumber sliding_back(const TyreNumber& q) {
  if (q.value <= 1) return {};
  const double excess = 1 - 1 / q.value;
  return compose(q, excess * excess, 2 * excess / (q.value * q.value));
}

}  // namespace

TyreForces SpringTyreLaw::calc(const TyreValues& values, bool touches) const {
  Numbers z;
  for (int k = 0; k < tyre_variables; ++k) z[static_cast<std::size_t>(k)] = TyreNumber(values[k], TyreValues::Unit(k));
  TyreForces forces;
  forces.slip.setZero();
  const TyreNumber V = compose(z[tyre_V_r], std::hypot(z[tyre_V_r].value, speed),
                               z[tyre_V_r].value / std::hypot(z[tyre_V_r].value, speed));
  const TyreNumber direction = z[tyre_V_r] / V;
  if (touches) {
    const double e = values[tyre_e];
    const ForceCurve::Values spring = curve ? (*curve)(e) : ForceCurve::Values{stiffness * e, stiffness};
    const TyreNumber S = compose(z[tyre_e], spring.force, spring.slope), push = S + damping * z[tyre_e_rate];
    if (push.value > 0) forces.N = push;
    forces.elastic = curve ? curve->energy(e) : 0.5 * stiffness * e * e;
    forces.dissipation = (forces.N.value - S.value) * values[tyre_e_rate];
    forces.along_roll = -(rolling_resistance * (forces.N * direction));
    forces.dissipation -= forces.along_roll.value * values[tyre_V_r];
  }
  if (slip) add_slip(z, direction, forces);
  return forces;
}

void SpringTyreLaw::add_slip(const Numbers& z, const TyreNumber& direction, TyreForces& forces) const {
  const Eigen::Vector2d K = slip->stiffness.cwiseQuotient(slip->relaxation);
  const TyreNumber &u_x = z[tyre_u_x], &u_y = z[tyre_u_y];
  const Eigen::Vector2d Ku2(K.x() * u_x.value * u_x.value, K.y() * u_y.value * u_y.value);
  forces.elastic += 0.5 * Ku2.sum();
  if (!(forces.N.value > 0)) {
    forces.u_x_rate = -1 / release_time * u_x;
    forces.u_y_rate = -1 / release_time * u_y;
    forces.dissipation += Ku2.sum() / release_time;
    return;
  }
  forces.F_x = -K.x() * u_x;
  forces.F_y = -K.y() * u_y;
  const TyreNumber most = slip->friction * forces.N, q = length_of(forces.F_x, forces.F_y) / most;
  const TyreNumber trail = slip->trail * (trail_factor(q) * direction),
                   lean = slip->camber / slip->stiffness.y() * (z[tyre_c] * direction);
  const TyreNumber &V_r = z[tyre_V_r], &v_x = z[tyre_v_x];
  const TyreNumber v_y = z[tyre_v_y] + lean * V_r - trail * z[tyre_spin];
  TyreNumber level(1.0);  // l(N)
  if (slip->stiffest_load) {
    const TyreNumber w = 1 / *slip->stiffest_load * forces.N;
    level = 2 * w / (square(w) + 1.0);
  }
  const TyreNumber s = level * length_of(slip->stiffness.x() * v_x, slip->stiffness.y() * v_y) / most;
  const TyreNumber decay = calc_decay(abs_of(V_r), s, *slip) / level, back = 1 / release_time * sliding_back(q);
  const TyreNumber decay_x = 1 / slip->relaxation.x() * decay + back, decay_y = 1 / slip->relaxation.y() * decay + back;
  forces.u_x_rate = v_x - decay_x * u_x;
  forces.u_y_rate = v_y - decay_y * u_y;
  forces.along_roll += lean * forces.F_y;
  forces.moment = -(trail * forces.F_y);
  forces.slip = Eigen::Vector2d(v_x.value, v_y.value) / std::hypot(V_r.value, speed);
  forces.dissipation += decay_x.value * Ku2.x() + decay_y.value * Ku2.y();
}

std::vector<std::string> SpringTyreLaw::describe() const {
  std::string normal = curve ? "radial force by a curve" : fmt::format("radial stiffness {:.6g} N/m", stiffness);
  if (damping > 0) normal += fmt::format(", damping {:.6g} N s/m", damping);
  if (rolling_resistance > 0) normal += fmt::format(", rolling resistance {:.6g}", rolling_resistance);
  std::vector<std::string> lines{normal};
  if (!slip) {
    lines.push_back("no forces along the road");
    return lines;
  }
  std::string along =
      fmt::format("slip stiffness {:.6g} N along, {:.6g} N across", slip->stiffness.x(), slip->stiffness.y());
  if (slip->stiffest_load) along += fmt::format(" (at a load of {:.6g} N)", *slip->stiffest_load);
  along += fmt::format(", relaxation length {:.6g} m and {:.6g} m, friction {:.6g}", slip->relaxation.x(),
                       slip->relaxation.y(), slip->friction);
  if (slip->shape)
    along += fmt::format(", magic formula of shape {:.6g} and curvature {:.6g}", *slip->shape, slip->curvature);
  if (slip->trail > 0) along += fmt::format(", trail {:.6g} m", slip->trail);
  if (slip->camber > 0) along += fmt::format(", camber stiffness {:.6g} N", slip->camber);
  lines.push_back(along);
  return lines;
}

}  // namespace bielle::mechanism
