// Reading of input files, and checks before the work begins that a file can be read or written.
#pragma once

#include <string>

namespace bielle {

/// @throws InputError if there is no file of that name, or it is a folder, a device or a named pipe. (The standard
///         input and what a shell hands over under /dev may be pipes.)
void check_input_file(const std::string& path);

/// Returns the bytes of a file that passes `check_input_file`. @throws InputError if it cannot be read
std::string read_input_text(const std::string& path);

/// @throws InputError when no file of that name can be written: no such folder, not permitted, a folder, a device or a
///         pipe, a name that is too long
void check_output_file(const std::string& path);

}  // namespace bielle
