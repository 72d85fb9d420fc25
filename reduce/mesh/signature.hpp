// A check by its first and last lines that a file has the format of its ending.
#pragma once

#include <string>

namespace bielle::reduce {

/// Checks STEP, BREP and MSH. Other formats have no signature, or their readers report the fault.
/// @throws InputError with the expected format
void check_signature(const std::string& path);

}  // namespace bielle::reduce
