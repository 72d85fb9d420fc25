// The `modes` and the `damping` of a body file.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reduce/reduction/mode_request.hpp"

namespace bielle {
class YamlValue;
struct KeyTable;
}  // namespace bielle

namespace bielle::reduce {

struct RequestedModes {
  ModeRequest request;
  bool proven = false;  ///< as in ReductionOptions
};

/// Damping ratios of the free modes, or Rayleigh damping, as in ReductionOptions.
struct RequestedDamping {
  std::vector<double> ratios;
  std::optional<std::array<double, 2>> rayleigh;
};

const KeyTable& modes_keys();
const KeyTable& damping_keys();

/// @throws InputError `file:line: key: what was expected`
RequestedModes read_modes(const YamlValue& value);
RequestedDamping read_damping(const YamlValue& value);

}  // namespace bielle::reduce
