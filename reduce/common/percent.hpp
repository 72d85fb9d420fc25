// Shares in percent, for messages.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace bielle {

/// "0.042", "3.1", "120": two digits at least, without an exponent for large numbers. @param share  0.031 is 3.1 %
inline std::string percent_number(double share) {
  const double value = 100 * share;
  return std::abs(value) < 99.5 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

/// "3.1 %"
inline std::string percent(double share) { return percent_number(share) + " %"; }

}  // namespace bielle
