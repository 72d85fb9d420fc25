// Units of numbers in input files: "210 GPa", "5 deg", "3000 rpm".
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bielle {

/// A number with a unit, as a user writes it.
struct Quantity {
  double value = 0;
  std::string unit;
};

/// Returns the finite number that a text is; nothing for any other text, such as a formula, or a number with a unit.
std::optional<double> plain_number(std::string_view text);

/// Returns the parts of a text that is a number, a blank and a unit; nothing for any other text, such as a formula.
std::optional<Quantity> quantity_of(std::string_view text);

/// Converts a quantity to SI units.
///
/// UDUNITS knows the units, their prefixes, products, quotients and powers ("N mm/deg", "kg/m^3"). An angle is a
/// dimension here: a frequency in Hz is not taken for an angular velocity in rad/s, which would be wrong by 2 pi.
/// @param units  SI unit that is expected, or several ("m or rad"); empty if a number without a unit is expected, "any"
///               if the quantity may have any unit
/// @throws InputError without file or line, with both units
double to_si(const Quantity& quantity, const std::string& units);

}  // namespace bielle
