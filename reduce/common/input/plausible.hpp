// Ranges of plausible values; values outside are possible but suggest another system of units, or degrees instead of
// radians.
#pragma once

#include "reduce/common/input/yaml_file.hpp"

namespace bielle {

struct PlausibleRange {
  double low, high;
  const char* text;  ///< description of the range, with an example
};

/// Moduli from light rubber to diamond (1.2e12 Pa).
inline constexpr PlausibleRange plausible_modulus{
    1e6, 2e12, "Solids have 1e6 (soft rubber) to 1.2e12 Pa (diamond); steel has 210e9"};
/// Densities from light foam to osmium (22590 kg/m^3).
inline constexpr PlausibleRange plausible_density{25, 25000,
                                                  "Solids have 25 (foam) to 23000 kg/m^3 (osmium); steel has 7850"};
/// Forces up to the weight of a mountain.
inline constexpr PlausibleRange plausible_load{-1e12, 1e12, "Forces are in newtons, moments in newton metres"};
inline constexpr PlausibleRange plausible_damping_ratio{
    0, 1, "1 is critical damping; joined structures have 0.005 to 0.05 (a ratio, no percentage)"};

/// Adds a warning if a value is out of range.
void warn_outside(const YamlValue& place, double value, const PlausibleRange& range);

/// Adds a warning if a formula of t jumps: a prescribed motion with a jump has no velocity there.
/// @param what  in words with its article: "the angle"
void warn_of_jumps(const YamlValue& place, const Expression& formula, const char* what);

}  // namespace bielle
