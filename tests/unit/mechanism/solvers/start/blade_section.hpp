// The section of the blades whose start is tested.
#pragma once

namespace bielle::test {

inline const char* const blade_section =
    "{EA: 2e6, GAy: 1e6, GAz: 1e6, GJ: 2e3, EIy: 2e3, EIz: 3e3, mass_per_length: 5, Jx: 0.02, Jy: 0.01, Jz: 0.01}";

}  // namespace bielle::test
