#include "mechanism/joints/flexible/rolling_bearing_law.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {
namespace {

using std::numbers::pi;
constexpr int spread = 180;  ///< number of positions on the ring if the elements are spread evenly
constexpr int slices = 9;    ///< number of positions along a roller

}  // namespace

/// A loaded contact: its deflection with derivatives, and its share of the elements.
struct RollingBearingLaw::Element {
  double share, delta;
  Vector6 gradient;
  Matrix6 second;
};

template <class Visit>
void RollingBearingLaw::for_each_loaded(const Vector6& e, const Visit& visit) const {
  const RollingGeometry& G = geometry_;
  const int places = G.discrete ? G.elements : spread;
  const double ratio = G.discrete ? G.cage_ratio : 0, first = G.discrete ? G.cage_angle + ratio * e[5] : 0;
  const double cosine = std::cos(G.contact_angle), sine = std::sin(G.contact_angle);
  Element element;
  element.share = static_cast<double>(G.elements) / places;
  for (int k = 0; k < places; ++k) {
    const double psi = first + 2 * pi * k / places, c = std::cos(psi), s = std::sin(psi), rho = G.contact_radius;
    const double radial = e[0] * c + e[1] * s, turn = e[4] * c - e[3] * s;
    const double r = radial - 0.5 * G.clearance, axial = e[2] + z_0_ - rho * turn;
    Vector6 by_r, by_s, by_t;
    by_t << 0, 0, 0, -s, c, ratio * (-e[4] * s - e[3] * c);
    by_r << c, s, 0, 0, 0, ratio * (-e[0] * s + e[1] * c);
    by_s = -rho * by_t;
    by_s[2] = 1;
    Matrix6 r_second = Matrix6::Zero(), t_second = Matrix6::Zero();
    if (ratio != 0) {
      r_second.col(5) << -ratio * s, ratio * c, 0, 0, 0, -0.5 * ratio * ratio * radial;
      t_second.col(5) << 0, 0, 0, -ratio * c, -ratio * s, -0.5 * ratio * ratio * turn;
      r_second = (r_second + r_second.transpose()).eval();
      t_second = (t_second + t_second.transpose()).eval();
    }
    if (G.ball) {
      const double A = G.groove_distance, p = A * cosine + r, q = A * sine + axial, l = std::hypot(p, q);
      element.delta = l - A;
      if (!(element.delta > 0)) continue;
      const double u = p / l, w = q / l;
      const Vector6 across = u * by_s - w * by_r;
      element.gradient = u * by_r + w * by_s;
      element.second = across * across.transpose() / l + u * r_second - rho * w * t_second;
      visit(element);
      continue;
    }
    const int parts = G.roller_length > 0 ? slices : 1;
    for (int i = 0; i < parts; ++i) {
      const double along = G.roller_length * ((i + 0.5) / parts - 0.5);
      Element part = element;
      part.share /= parts;
      part.delta = r * cosine + axial * sine + along * turn;
      if (!(part.delta > 0)) continue;
      part.gradient = cosine * by_r + sine * by_s + along * by_t;
      part.second = cosine * r_second + (along - rho * sine) * t_second;
      visit(part);
    }
  }
}

RollingBearingLaw::RollingBearingLaw(const RollingGeometry& geometry, double preload)
    : geometry_(geometry), preload_(preload) {
  if (preload > 0) z_0_ = displacement_of(preload);
}

/// Finds the displacement by bisection, because the axial force grows with it.
double RollingBearingLaw::displacement_of(double preload) const {
  const auto force_at = [&](double z) {
    Vector6 e = Vector6::Zero();
    e[2] = z;
    return potential(e).N[2];
  };
  double low = -1e-9, high = 1e-9;
  while (force_at(low) > preload) low *= 2;
  while (force_at(high) < preload && high < geometry_.pitch_diameter) high *= 2;
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (force_at(middle) < preload ? low : high) = middle;
  return high;
}

BearingLaw::Force RollingBearingLaw::calc(const Vector6& e, const Vector6& /*v*/) const {
  const double n = geometry_.exponent, K = geometry_.constant;
  Force force;
  for_each_loaded(e, [&](const Element& element) {
    const double Q = element.share * K * std::pow(element.delta, n);
    force.N += Q * element.gradient;
    force.by_e += n * Q / element.delta * element.gradient * element.gradient.transpose();
    force.by_e += Q * element.second;
  });
  return force;
}

BearingLaw::Potential RollingBearingLaw::potential(const Vector6& e) const {
  const double n = geometry_.exponent, K = geometry_.constant;
  Potential potential;
  for_each_loaded(e, [&](const Element& element) {
    const double Q = element.share * K * std::pow(element.delta, n);
    potential.energy += Q * element.delta / (n + 1);
    potential.N += Q * element.gradient;
  });
  return potential;
}

std::vector<std::string> RollingBearingLaw::describe() const {
  const RollingGeometry& G = geometry_;
  std::vector<std::string> facts{
      fmt::format("{} {} on {:.6g} m, contact angle {:.6g} degrees, diametral clearance {:.6g} m", G.elements,
                  G.ball ? "balls" : "rollers", G.pitch_diameter, degrees(G.contact_angle), G.clearance),
      fmt::format("force of an element {:.6g} N/m^{} times the deflection to the power {}", G.constant,
                  G.ball ? "1.5" : "(10/9)", G.ball ? "1.5" : "10/9")};
  if (G.discrete) facts.push_back(fmt::format("the cage turns by {:.6g} of the angle of the shaft", G.cage_ratio));
  if (preload_ > 0)
    facts.push_back(fmt::format("preload {:.6g} N, from an axial displacement of {:.6g} m", preload_, z_0_));
  return facts;
}

}  // namespace bielle::mechanism
