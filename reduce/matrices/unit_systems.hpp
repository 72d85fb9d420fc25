// Systems of units in which matrices of other programs are written.
#pragma once

#include <array>
namespace bielle::reduce {

struct UnitSystem {
  const char* name;
  double length, mass, time;  ///< its units [m, kg, s]
};

inline constexpr std::array<UnitSystem, 5> unit_systems = {{{"m-kg-s", 1, 1, 1},
                                                            {"mm-t-s", 1e-3, 1e3, 1},
                                                            {"mm-kg-ms", 1e-3, 1, 1e-3},
                                                            {"mm-kg-s", 1e-3, 1, 1},
                                                            {"in-slinch-s", 0.0254, 175.126836, 1}}};

}  // namespace bielle::reduce
