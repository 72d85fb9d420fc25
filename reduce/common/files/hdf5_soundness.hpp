// HDF5 files that the library would crash on.
#pragma once

#include <string>

namespace bielle {

/// Walks through all groups, attributes, types, texts and chunks of a file in a process of its own, since the HDF5
/// library crashes, or never ends, on some damage of what describes them. A file is walked through once for as long as
/// it is not written again.
/// @throws InputError when the walk does not come to its end
void check_sound(const std::string& path);

}  // namespace bielle
