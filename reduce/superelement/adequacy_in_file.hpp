// What a superelement is good for, in its file: the group /adequacy.
#pragma once

#include <optional>

#include "reduce/superelement/adequacy.hpp"

namespace bielle {

class Hdf5File;

void write_adequacy(const Adequacy& adequacy, Hdf5File& file);

/// Nothing when the file has none. @throws InputError when a dataset is missing or its size is not that of the others
std::optional<Adequacy> read_adequacy(const Hdf5File& file);

}  // namespace bielle
