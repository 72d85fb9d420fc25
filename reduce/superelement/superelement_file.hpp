// A superelement as a part of an open file, shared by the files of whole and of cut bodies.
#pragma once

#include <string>

namespace bielle {

class Hdf5File;
struct Superelement;

/// Name of the file format: the attribute `format` of the group.
inline constexpr const char* superelement_format = "bielle superelement";

/// @throws ComputationError when the superelement's parts do not fit together: `path` would not be readable
void check_writable(const Superelement& superelement, const std::string& path);

/// Writes into the group that the file has entered, attributes included.
void write_superelement(const Superelement& superelement, Hdf5File& file);

/// Reads from the group that the file has entered. @throws InputError as for a whole file
Superelement read_superelement(const Hdf5File& file);

/// Reads what a mechanism needs in every run: interfaces, reduced matrices and loads, modes, mass properties. The
/// file's sum of bytes vouches for the rest; a file without it is read and checked as a whole.
/// @throws InputError as for a whole file
Superelement read_parts_of_motion(const Hdf5File& file);

}  // namespace bielle
