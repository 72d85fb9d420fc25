// Readers of `stiffness` and `errors` of a gear mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "mechanism/joints/gears/iso_stiffness.hpp"
#include "mechanism/joints/gears/mesh_function.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "mechanism/reading/read_rows.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

const std::vector<std::string> wheel_variables{"phi"};
const std::vector<std::string> mesh_variables{"phi", "phi_2"};  ///< angles of the first and the second wheel

/// Returns the keys of a function of the angle of one wheel. @param teeth  whether `teeth` is required
std::vector<Key> periodic_keys(const std::string& unit, const Presence& teeth, const std::string& quantity) {
  using namespace keys;
  return {{"table",
           {file("table of two columns"), list_of(list_of(2, number()))},
           optional,
           "Positions within a period, from 0 to 1, and " + quantity + " [" + unit +
               "], which a periodic cubic spline joins; the last value repeats the first."},
          {"wheel", integer().between(1, 2), otherwise("1"), "Wheel whose angle turns the table."},
          {"teeth", integer().at_least(1), teeth,
           "Periods in a turn of the wheel: its number of teeth, for a period of a pitch."},
          {"phase", number(), otherwise("0"), "Position within the period as drawn."}};
}

const KeyTable& error_keys() {
  using namespace keys;
  static const KeyTable table{"an error of the teeth", "A periodic error of the flanks of two wheels.",
                              joined({periodic_keys("m", otherwise("1"), "errors"),
                                      {{"formula", formula("m", wheel_variables), optional,
                                        "Formula of the angle phi [rad] of the wheel, in place of `table`."}}})};
  return table;
}

const KeyTable& iso_keys() {
  using namespace keys;
  static const KeyTable table{
      "`iso`",
      "Mean stiffness of the mesh of cylindrical steel wheels after ISO 6336-1, method B.",
      {{"width", number("m").positive(), required, "Common width of the teeth."},
       {"teeth", list_of(2, number().positive()), required, "Numbers of teeth of the two wheels."},
       {"shifts", list_of(2, number()), otherwise("[0, 0]"), "Profile shift coefficients of the two wheels."},
       {"contact_ratio", number().at_least(1), computed("from teeth of the height of one module, mounted without play"),
        "Transverse contact ratio."},
       {"dedendum", number().positive(), otherwise("1.2"), "Dedendum of the basic rack, over the module."},
       {"blank", number().positive(), otherwise("1"), "Factor C_R of the wheels' blanks; 1 for solid wheels."},
       {"young", number("Pa").positive(), otherwise("206e9"), "Modulus of elasticity of both wheels."}}};
  return table;
}

const KeyTable& stiffness_keys() {
  using namespace keys;
  static const KeyTable table{
      "a stiffness of teeth",
      "A stiffness of the teeth that depends on the position of the mesh, or follows from their size.",
      joined({{{"iso", nested(iso_keys), optional, "Stiffness by geometry, in place of `table`."}},
              periodic_keys("N/m", optional, "stiffnesses")})};
  return table;
}

Interpolation read_period(const YamlValue& value) {
  const Eigen::MatrixXd rows = read_rows(value, 2, "[position, value]");
  const Eigen::Index last = rows.rows() - 1;
  if (last < 3 || rows(0, 0) != 0 || rows(last, 0) != 1)
    value.fail("expected at least four rows, with positions from 0 to 1, a whole period");
  try {
    return {rows.col(0), rows.col(1), Interpolation::Kind::periodic, "the table"};
  } catch (const InputError& error) {
    value.fail(error.what());
  }
}

int wheel_of(const YamlValue& entry) { return entry.at("wheel").integer() - 1; }

void add_error(const YamlValue& given, MeshFunction& errors) {
  const YamlValue entry = given.keyed(error_keys());
  if (entry.has("table") == entry.has("formula")) entry.fail("expected either a `table` or a `formula` of phi");
  if (const auto formula = entry.find("formula")) {
    for (const char* key : {"teeth", "phase"})
      if (const auto too_much = entry.find(key)) too_much->fail("belongs to a `table`");
    errors.add(formula->expression(), wheel_of(entry));
    return;
  }
  errors.add(read_period(entry.at("table")), wheel_of(entry), entry.at("teeth").integer(), entry.at("phase").number());
}

MeshFunction read_iso(const YamlValue& given, const ToothGeometry& geometry, double helix, bool internal) {
  const YamlValue entry = given.keyed(iso_keys());
  const auto pair_of = [&](const char* key) -> std::array<double, 2> {
    const Eigen::VectorXd both = read_numbers(entry.at(key), 2, "a number for each wheel");
    return {both[0], both[1]};
  };
  CylindricalTeeth pair{entry.at("width").number(), pair_of("teeth"), {}, geometry.pressure_angle, helix};
  pair.shifts = pair_of("shifts");
  if (const double sum = pair.shifts[0] + pair.shifts[1]; !(sum >= -0.5 && sum <= 2))
    entry.at("shifts").fail(
        fmt::format("expected a sum between -0.5 and 2, for which the standard is valid; it is {:.6g}", sum));
  if (geometry.axis[0].cross(geometry.axis[1]).norm() > 1e-6) given.fail("is for cylindrical wheels, on parallel axes");
  const auto arm = [&](std::size_t k) { return geometry.axis[k].cross(geometry.P - geometry.centre[k]).norm(); };
  if (std::abs(pair.teeth[0] * arm(1) - pair.teeth[1] * arm(0)) > 1e-3 * pair.teeth[0] * arm(1))
    entry.at("teeth").fail(fmt::format("expected the ratio of the pitch radii, {:.6g} to {:.6g} m", arm(0), arm(1)));
  if (pair.teeth[0] > pair.teeth[1]) {  // the standard begins with the pinion
    std::swap(pair.teeth[0], pair.teeth[1]);
    std::swap(pair.shifts[0], pair.shifts[1]);
  }
  pair.ring = internal;
  pair.dedendum = entry.at("dedendum").number();
  pair.blank = entry.at("blank").number();
  pair.young = entry.at("young").number();
  const auto ratio = entry.find("contact_ratio");
  if (!ratio && internal) entry.fail("give the `contact_ratio` of an internal pair");
  const double contact_ratio = ratio ? ratio->number() : transverse_contact_ratio(pair);
  if (!(contact_ratio >= 1)) entry.fail("these teeth have no contact ratio of at least 1: give the `contact_ratio`");
  if (contact_ratio < 1.2)
    entry.warn(fmt::format("the contact ratio is {:.3g}: ISO 6336-1 gives the stiffness from 1.2 on", contact_ratio));
  const double k = iso_stiffness(pair, contact_ratio).normal;
  if (!(k > 0 && k < Expression::most)) entry.fail("these teeth have no positive stiffness");
  return MeshFunction(k);
}

/// @param where  the angles in words @throws InputError if the function is not positive at the angles of the wheels
void check_positive_at(const MeshFunction& stiffness, const std::array<double, 2>& angles, const std::string& where,
                       const YamlValue& value) {
  try {
    if (const double found = stiffness.value(angles); !(found > 0))
      value.fail(fmt::format("expected a stiffness greater than 0; it is {:.4g} N/m at {}", found, where));
  } catch (const ComputationError& error) {  // the message names the place
    throw InputError(error.what());
  }
}

/// Checks samples of a period of a table, or of a turn of the first wheel. @param teeth  periods in a turn
void check_positive(const MeshFunction& stiffness, const YamlValue& value, double teeth) {
  const int samples = 16384;
  for (int k = 0; k < samples; ++k) {
    const double angle = 2 * M_PI * k / (samples * teeth);
    check_positive_at(stiffness, {angle, angle}, fmt::format("the angle {:.6g} rad", angle), value);
  }
}

/// Checks samples of a turn of both wheels, each at any angle of the other one.
void check_positive_of_both(const MeshFunction& stiffness, const YamlValue& value) {
  const int samples = 180;
  for (int k = 0; k < samples; ++k)
    for (int j = 0; j < samples; ++j) {
      const std::array<double, 2> angles{2 * M_PI * k / samples, 2 * M_PI * j / samples};
      check_positive_at(
          stiffness, angles,
          fmt::format("the angles {:.6g} rad of the first wheel and {:.6g} rad of the second", angles[0], angles[1]),
          value);
    }
}

}  // namespace

KeyForms tooth_error_forms() {
  return {keys::formula("m", mesh_variables), keys::nested(error_keys), keys::list_of(keys::nested(error_keys))};
}

MeshFunction read_tooth_errors(const YamlValue& value) {
  MeshFunction errors;
  if (value.is_sequence())
    for (const YamlValue& item : value.items()) add_error(item, errors);
  else if (value.is_map())
    add_error(value, errors);
  else
    errors.add_of_both(value.expression());
  return errors;
}

KeyForms tooth_stiffness_forms() {
  return {keys::formula("N/m", mesh_variables).positive(), keys::nested(stiffness_keys)};
}

MeshFunction read_tooth_stiffness(const YamlValue& value, const ToothGeometry& geometry, double helix, bool internal) {
  if (!value.is_map()) {
    Expression formula = value.expression();
    if (formula.is_constant()) return MeshFunction(value.number());
    MeshFunction stiffness;
    const bool of_both = formula.uses(1);
    stiffness.add_of_both(std::move(formula));
    if (of_both)
      check_positive_of_both(stiffness, value);
    else
      check_positive(stiffness, value, 1);
    return stiffness;
  }
  const YamlValue entry = value.keyed(stiffness_keys());
  if (entry.has("table") == entry.has("iso")) entry.fail("expected either a `table` or `iso`");
  if (const auto iso = entry.find("iso")) {
    for (const char* key : {"wheel", "teeth", "phase"})
      if (const auto too_much = entry.find(key)) too_much->fail("belongs to a `table`");
    return read_iso(*iso, geometry, helix, internal);
  }
  if (!entry.has("teeth")) entry.fail("give the number of `teeth` of the wheel, whose pitch is the period");
  MeshFunction stiffness;
  const int teeth = entry.at("teeth").integer();
  stiffness.add(read_period(entry.at("table")), wheel_of(entry), teeth, entry.at("phase").number());
  check_positive(stiffness, entry.at("table"), teeth);
  return stiffness;
}

}  // namespace bielle::mechanism
