#include "mechanism/joints/tyres/tyre_law.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

using Numbers = std::array<TyreNumber, tyre_variables>;

constexpr double release_time = 1e-3;  // T [s]

/// Returns |x|, whose derivative is taken as zero at zero.
TyreNumber abs_of(const TyreNumber& x) { return x.value < 0 ? -x : x.value > 0 ? x : TyreNumber(); }

/// Returns the length of (x, y), whose derivative is taken as zero at the origin.
TyreNumber length_of(const TyreNumber& x, const TyreNumber& y) {
  const double length = std::hypot(x.value, y.value);
  if (length == 0) return {};
  return compose(x, y, length, x.value / length, y.value / length);
}

/// A function of rho with its slope.
struct SlipFunction {
  double value, slope;
};

/// Returns g(rho).
SlipFunction friction_share(double rho, const TyreSlip& slip) {
  if (!slip.shape) {
    if (rho >= slip.peak) return {1, 0};
    return {rho * (1 - rho / 3 + rho * rho / 27), (1 - rho / 3) * (1 - rho / 3)};
  }
  const double C = *slip.shape, E = slip.curvature, B = 1 / C, x = B * rho, X = x - E * (x - std::atan(x));
  const double phi = std::atan(X);
  return {std::sin(C * phi), std::cos(C * phi) * C / (1 + X * X) * B * (1 - E * x * x / (1 + x * x))};
}

/// Returns rho/g(rho), which is 1 without slip.
SlipFunction slip_ratio(double rho, const TyreSlip& slip) {
  if (!slip.shape) {
    const double y = 1 / (1 - rho / 3 + rho * rho / 27);
    return {y, (1.0 / 3 - 2 * rho / 27) * y * y};
  }
  constexpr double tiny = 1e-6;
  if (rho < tiny) return {1, 0};
  const SlipFunction g = friction_share(rho, slip);
  return {rho / g.value, (g.value - rho * g.slope) / (g.value * g.value)};
}

/// Friction at a slip.
struct Grip {
  TyreNumber rolling;  ///< |V_r| rho/g(rho) [m/s], rho no larger than rho_c
  TyreNumber share;    ///< g(rho), rho no smaller than rho_c
};

/// @param V  |V_r| [m/s] @param s  |C l v'|/(mu N) [m/s]
Grip calc_grip(const TyreNumber& V, const TyreNumber& s, const TyreSlip& slip) {
  constexpr double all_slides = 1e9;
  const bool locked = !(s.value < all_slides * V.value);
  const double rho = locked ? all_slides : s.value / V.value;
  const SlipFunction y = slip_ratio(std::min(rho, slip.peak), slip);
  if (rho < slip.peak)
    return {compose(V, s, V.value * y.value, y.value - rho * y.slope, y.slope), friction_share(slip.peak, slip).value};
  const SlipFunction g = friction_share(rho, slip);
  if (locked) return {y.value * V, g.value};
  return {y.value * V, compose(V, s, g.value, -g.slope * rho / V.value, g.slope / V.value)};
}

/// Returns t/t_0 of the brush model. @param q  force over mu N
TyreNumber trail_factor(const TyreNumber& q) {
  if (q.value >= 1) return {};
  // d(p^3) = -dq, and p' = -1/(3 p^2), which is multiplied by p^3.
  const double p = std::cbrt(1 - q.value), sum = 1 + p + p * p;
  return compose(q, 3 * p * p * p / sum, -3 / sum + p * (1 + 2 * p) / (sum * sum));
}

}  // namespace

double peak_of_formula(double C, double E) {
  constexpr double farthest = 10;
  TyreSlip slip;
  slip.shape = C;
  slip.curvature = E;
  if (friction_share(farthest, slip).slope >= 0) return farthest;
  double rising = 0, falling = farthest;
  for (double rho = farthest / 2; rho > rising && rho < falling; rho = 0.5 * (rising + falling))
    (friction_share(rho, slip).slope > 0 ? rising : falling) = rho;
  return rising;
}

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
    if (push.value >= 0) forces.N = push;
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
  const TyreNumber f_x = K.x() * u_x, f_y = K.y() * u_y;
  const TyreNumber most = slip->friction * forces.N;
  const TyreNumber trail = slip->trail * (trail_factor(length_of(f_x, f_y) / most) * direction),
                   lean = slip->camber / slip->stiffness.y() * (z[tyre_c] * direction);
  const TyreNumber &V_r = z[tyre_V_r], &v_x = z[tyre_v_x];
  const TyreNumber v_y = z[tyre_v_y] + lean * V_r - trail * z[tyre_spin];
  TyreNumber level(1.0);  // l(N)
  if (slip->stiffest_load) {
    const TyreNumber w = 1 / *slip->stiffest_load * forces.N;
    level = 2 * w / (square(w) + 1.0);
  }
  const TyreNumber c_x = slip->stiffness.x() * v_x, c_y = slip->stiffness.y() * v_y;
  const Grip grip = calc_grip(abs_of(V_r), level * length_of(c_x, c_y) / most, *slip);
  const TyreNumber eta = standing_damping(V_r), returned = eta + release_time / slip->relaxation.x();
  const TyreNumber rolling = grip.rolling / level,
                   sliding =
                       (length_of(f_x + returned * c_x, f_y + returned * c_y) / (most * grip.share) - 1.0) / returned;
  const TyreNumber decay = sliding.value > rolling.value ? sliding : rolling, damped = eta * decay + 1.0;
  forces.u_x_rate = v_x - 1 / slip->relaxation.x() * (decay * u_x);
  forces.u_y_rate = v_y - 1 / slip->relaxation.y() * (decay * u_y);
  forces.F_x = -(f_x + eta * c_x) / damped;
  forces.F_y = -(f_y + eta * c_y) / damped;
  forces.along_roll += lean * forces.F_y;
  forces.moment = -(trail * forces.F_y);
  forces.slip = Eigen::Vector2d(v_x.value, v_y.value) / std::hypot(V_r.value, speed);
  forces.dissipation +=
      decay.value * (Ku2.x() / slip->relaxation.x() + Ku2.y() / slip->relaxation.y()) +
      eta.value / damped.value * (c_x.value * forces.u_x_rate.value + c_y.value * forces.u_y_rate.value);
}

/// Returns eta, which decreases with the speed and is zero from v_0 on.
TyreNumber SpringTyreLaw::standing_damping(const TyreNumber& V_r) const {
  const double w = V_r.value / speed, left = 1 - w * w;
  if (!(left > 0)) return {};
  return compose(V_r, slip->damping * left * left, -4 * slip->damping * w * left / speed);
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
  if (slip->damping > 0)
    along += fmt::format(", damping of the standing tread {:.6g} N s/m", slip->damping * slip->stiffness.x());
  if (slip->shape)
    along += fmt::format(", magic formula of shape {:.6g} and curvature {:.6g}", *slip->shape, slip->curvature);
  if (slip->trail > 0) along += fmt::format(", trail {:.6g} m", slip->trail);
  if (slip->camber > 0) along += fmt::format(", camber stiffness {:.6g} N", slip->camber);
  lines.push_back(along);
  return lines;
}

}  // namespace bielle::mechanism
