// Units of length: the factor that converts the numbers of a geometry to metres. All later code works in metres.
#pragma once

#include <optional>
#include <string>

namespace bielle::reduce {

/// Metres per unit. @param unit  one of m, mm, cm, um, km, in, ft. @throws InputError (without a place) for any other
double metres_per(const std::string& unit);

/// Name of a factor, "m", "mm" ...; "0.123 m" if it has none.
std::string unit_name(double metres);

/// Metres per unit of length that a STEP file declares, from its text (SI_UNIT with or without prefix, or
/// CONVERSION_BASED_UNIT); empty if it declares none, or several that differ.
std::optional<double> step_length_unit(const std::string& path);

}  // namespace bielle::reduce
