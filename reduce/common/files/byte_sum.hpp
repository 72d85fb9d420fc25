// A sum of all bytes of a file, at its end: a line that names it, and 8 bytes.
//
// A file with its own sum is as it was written, to the last byte, so that a library that crashes on damaged files reads
// it safely. HDF5 does not look at bytes beyond its last object, and cuts them off when it writes to the file: a file
// that another program has changed has no sum any more. The sum detects damage; it does not detect forgery.
#pragma once

#include <string>

namespace bielle {

/// Adds the sum to a complete file that has none. @throws ComputationError if it cannot be read or written
void append_byte_sum(const std::string& path);

/// Tells whether the file ends with the sum of its other bytes. Reads the whole file if it ends with a sum.
bool has_own_byte_sum(const std::string& path);

}  // namespace bielle
