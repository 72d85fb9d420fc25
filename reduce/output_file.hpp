// The superelement file that a command writes.
#pragma once

#include <initializer_list>
#include <string>

namespace bielle::reduce {

/// Refuses an output, before the long work, that could not be written or would overwrite an input.
/// @throws InputError
void check_output(const std::string& path, std::initializer_list<std::string> inputs);

/// "written: body.h5 (1.2 MB)", for the end of a summary.
std::string written(const std::string& path);

}  // namespace bielle::reduce
