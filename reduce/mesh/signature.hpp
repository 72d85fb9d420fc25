// Whether a file is of the format that its ending says, as far as its first and last lines tell.
#pragma once

#include <string>

namespace bielle::reduce {

/// STEP, BREP and MSH. Other formats have no signature, or readers that tell what is wrong.
/// @throws InputError with what was expected
void check_signature(const std::string& path);

}  // namespace bielle::reduce
