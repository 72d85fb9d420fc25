// A check for HDF5 files on which the library would crash.
#pragma once

#include <string>

namespace bielle {

/// A file that ends with the sum of its bytes (byte_sum.hpp) is sound. For any other one, reads all groups, attributes,
/// types, texts and chunks in a child process, since the HDF5 library crashes, or does not terminate, on some damaged
/// metadata. A file is checked once until it is written again.
/// @throws InputError if the child process does not read the file to its end or finds a fault
void check_sound(const std::string& path);

/// Tells whether a file ends with the sum of its bytes, so that its numbers need no check either. It checks the file as
/// `check_sound` does, once.
bool is_as_written(const std::string& path);

/// Reads a text attribute of a file's root in a child process, without a check of the rest.
/// @returns "" if there is no such file, attribute or text, or if it is damaged
std::string root_text_attribute(const std::string& path, const std::string& name);

}  // namespace bielle
