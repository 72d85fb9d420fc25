// STEP files of assemblies with names, for tests.
#pragma once

#include <string>

#include "tests/support/temporary_folder.hpp"

namespace bielle::test {

/// Writes a STEP file of the assembly "gripper": a part "arm" of 100 x 10 x 10 mm from the origin, and the assembly
/// "finger" twice, as instances "left" and "right". A finger is a part "tip" of 20 x 10 x 10 mm. The left one touches
/// the arm at x = 100 mm, the right one lies 50 mm higher.
/// @returns the path of the file
std::string step_assembly(const TemporaryFolder& folder);

}  // namespace bielle::test
