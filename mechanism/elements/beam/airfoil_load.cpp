#include "mechanism/elements/beam/airfoil_load.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mechanism/elements/beam/load_pieces.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::size_t wind_along = 0, wind_in_time = 1;  // argument numbers of the wind's formulas

/// Returns the pieces of the integral between the places along the beam at which coefficients, chord or twist have a
/// kink.
std::vector<double> airfoil_pieces(const Airfoil& airfoil, const BeamSpan& span) {
  std::vector<double> places = airfoil.polars.break_points();
  for (const Expression* formula : {&airfoil.chord, &airfoil.twist})
    for (const double s : formula->break_points(wind_along)) places.push_back(s);
  add_break_points(airfoil.wind, wind_along, places);
  return pieces_between(places, span.s_A, span.s_B);
}

}  // namespace

AirfoilLoad::AirfoilLoad(std::string name, const BeamSpan& span, Airfoil airfoil)
    : SpanLoad(std::move(name), span, airfoil_pieces(airfoil, span)), airfoil_(std::move(airfoil)) {}

void AirfoilLoad::declare(Declaration& declaration) const {
  declaration.nodes = {span().node_a, span().node_b};
  declaration.stiffness = declaration.damping = true;
}

AirfoilLoad::Strip AirfoilLoad::strip(const LocalState& state, const SpanPoint& point, const SpanSection& at,
                                      double twist_rate) const {
  const double s = point.along(span());
  const std::array<double, 2> place{s, state.time()};
  const Vector3 wind(airfoil_.wind[0](place), airfoil_.wind[1](place), airfoil_.wind[2](place));
  Strip strip{at.S.transpose() * (wind - span_velocity(point, state)),
              Vector3::Zero(),
              Vector3::Zero(),
              Matrix3::Zero(),
              Matrix3::Zero(),
              Vector3::Zero(),
              Vector3::Zero()};
  const double twist = airfoil_.twist(s), chord = airfoil_.chord(s);
  const Vector3 e_c(0, std::cos(twist), std::sin(twist)), e_n(0, -std::sin(twist), std::cos(twist));
  const Vector3 e_x = Vector3::UnitX();
  Vector3 u(0, strip.u.y(), strip.u.z()), u_by_twist = Vector3::Zero();
  if (airfoil_.pitch_rate) u_by_twist = -e_x.cross(airfoil_.at + 0.5 * chord * e_c);
  u += twist_rate * u_by_twist;
  const double U = u.norm();
  if (U == 0) return strip;
  const double alpha = std::atan2(u.dot(e_n), u.dot(e_c));
  const auto [cl, cd, cm] = airfoil_.polars(s, alpha);
  const double pressure = 0.5 * state.environment().load_factor * airfoil_.density * chord;
  const Vector3 across = e_x.cross(u), along = cd.value * u + cl.value * across;
  const Vector3 alpha_by_u = across / (U * U);  // a turn of u about x
  Matrix3 in_plane = Matrix3::Identity();
  in_plane(0, 0) = 0;
  strip.F = pressure * U * along;
  strip.F_by_u =
      pressure * (along * u.transpose() / U + U * (cd.value * in_plane + cl.value * skew(e_x) * in_plane +
                                                   (cd.slope * u + cl.slope * across) * alpha_by_u.transpose()));
  strip.M = -pressure * chord * U * U * cm.value * e_x + airfoil_.at.cross(strip.F);
  strip.M_by_u = -pressure * chord * e_x * (2 * cm.value * u + U * U * cm.slope * alpha_by_u).transpose() +
                 skew(airfoil_.at) * strip.F_by_u;
  if (!airfoil_.pitch_rate) return strip;
  const double damping = M_PI / 8 * pressure * chord * chord;  // pi/16 rho c^3
  strip.M -= damping * U * twist_rate * e_x;
  strip.M_by_u -= damping * twist_rate / U * e_x * u.transpose();
  strip.F_by_twist = strip.F_by_u * u_by_twist;
  strip.M_by_twist = strip.M_by_u * u_by_twist - damping * U * e_x;
  return strip;
}

SpanForce AirfoilLoad::load(const LocalState& state, const SpanPoint& point, const SpanSection& at) const {
  const double twist_rate = airfoil_.pitch_rate ? span_angular_velocity(span(), at, state).x() : 0;
  const Strip here = strip(state, point, at, twist_rate);
  return {at.S * here.F, here.M};
}

/// Adds the derivatives of f = S F(u) and n = M(u), with du = u~ dTheta(z) - S^T dv.
void AirfoilLoad::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  for (const SpanPoint& point : points()) {
    const SpanSection at = span_section(span(), point, state);
    SpanTwistRate twist;
    if (airfoil_.pitch_rate) twist = span_twist_rate(span(), point, at, state);
    const Strip here = strip(state, point, at, twist.value);
    const Matrix3 turn = skew(here.u), f_turn = at.S * (here.F_by_u * turn - skew(here.F)), n_turn = here.M_by_u * turn;
    if (tangent.wants_K)
      add_span_tangent(span(), point, at, {at.S * here.F, here.M}, f_turn, n_turn, state, tangent.K.dense());
    const Matrix3 f_rate = -at.S * here.F_by_u * at.S.transpose(), n_rate = -here.M_by_u * at.S.transpose();
    add_span_rate_tangent(span(), point, at, f_rate, n_rate, state, tangent);
    if (airfoil_.pitch_rate)
      add_span_twist_tangent(span(), point, at, twist, {at.S * here.F_by_twist, here.M_by_twist}, state, tangent);
  }
}

void AirfoilLoad::add_break_points(std::vector<double>& times) const {
  mechanism::add_break_points(airfoil_.wind, wind_in_time, times);
}

std::vector<TimeDependent::Formula> AirfoilLoad::time_formulas() const {
  std::vector<Formula> formulas;
  for (std::size_t k = 0; k < 3; ++k)
    if (airfoil_.wind[k].uses(wind_in_time)) formulas.push_back({fmt::format("wind {}", "xyz"[k]), "m/s"});
  return formulas;
}

void AirfoilLoad::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  const std::array<double, 2> middle{0.5 * (span().s_A + span().s_B), state.time()};
  std::size_t next = 0;
  for (const Expression& component : airfoil_.wind)
    if (component.uses(wind_in_time)) values[next++] = component(middle);
}

void AirfoilLoad::describe(const LocalState& /*state*/, Description& description) const {
  if (span().s_A > 0) return;  // the load is the same on all elements
  description.add_line(fmt::format("airfoil: chord {} m, twist {} rad, wind {} m/s, air of {:.6g} kg/m^3",
                                   airfoil_.chord.text(), airfoil_.twist.text(), format_vector(airfoil_.wind),
                                   airfoil_.density));
}

const KeyTable& airfoil_keys() {
  using namespace keys;
  static const KeyTable table{
      "an airfoil",
      "Aerodynamic forces along a beam, by the angle of attack alpha in each section. Formulas of s go from 0 at its "
      "start to 1 at its end.",
      joined(
          {{{"chord", formula("m", {"s"}), required, "Chord as a formula of s."},
            {"twist", formula("rad", {"s"}).as_pseudoscalar(), otherwise("0"),
             "Angle about the section's x axis from its y axis to the direction from the leading to the trailing edge, "
             "as a "
             "formula of s."},
            {"at", list_of(2, number("m")), otherwise("[0, 0]"),
             "Point of the section at which lift and drag act, the quarter chord, from the node line along y and z."}},
           airfoil_polar_keys(),
           {{"pitch_rate", boolean(), otherwise("true"),
             "Whether turning about the beam counts: alpha at the three-quarter chord, and damping of the moment."},
            {"density", number("kg/m^3").non_negative(), otherwise("1.225"), "Density of the air."},
            {"wind", list_of(3, formula("m/s", {"s", "t"})).as_vector().in_inertial_axes(), otherwise("[0, 0, 0]"),
             "Velocity of the air as formulas of s and the time t."}}})};
  return table;
}

Airfoil read_airfoil(const YamlValue& value) {
  Airfoil airfoil;
  airfoil.density = value.at("density").number();
  airfoil.wind = read_formula_vector(value.at("wind"), "three components, numbers or expressions of s and t");
  airfoil.chord = value.at("chord").expression();
  airfoil.twist = value.at("twist").expression();
  airfoil.polars = read_airfoil_polars(value);
  const Vector2 point = read_numbers(value.at("at"), 2, "the point [y, z] of the section, from the node line");
  airfoil.at = {0, point[0], point[1]};
  airfoil.pitch_rate = value.at("pitch_rate").boolean();
  constexpr int samples = 32;
  for (int k = 0; k <= samples; ++k) {
    const double s = static_cast<double>(k) / samples;
    try {
      if (!(airfoil.chord(s) > 0))
        value.at("chord").fail(
            fmt::format("expected a chord greater than 0, found {:.6g} m at s = {:.6g}", airfoil.chord(s), s));
      airfoil.twist(s);
    } catch (const ComputationError& error) {  // the message names the place
      throw InputError(error.what());
    }
  }
  return airfoil;
}

}  // namespace bielle::mechanism
