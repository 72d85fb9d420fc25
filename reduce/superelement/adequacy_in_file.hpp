// The accuracy of a superelement in its file: the group /adequacy.
#pragma once

#include <optional>

#include "reduce/superelement/adequacy.hpp"

namespace bielle {

class Hdf5File;

void write_adequacy(const Adequacy& adequacy, Hdf5File& file);

/// Returns nothing if the file has no such group. @throws InputError if a dataset is missing or its size differs from
/// that of the others
std::optional<Adequacy> read_adequacy(const Hdf5File& file);

}  // namespace bielle
