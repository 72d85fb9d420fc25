// The command `bielle-reduce --from`, and body files with `matrices`: a superelement of another program's matrices.
#pragma once

#include <string>

#include "reduce/body_file/body_file.hpp"
#include "reduce/common/command_line.hpp"

namespace bielle::reduce {

/// Reads, verifies and reduces matrices, writes the superelement and prints its summary. Checks of the verification
/// that fail are shown as warnings.
void reduce_matrices_of(const MatrixBody& body, const std::string& output, const CommonOptions& common,
                        Progress& progress);

/// Does the same for a file without a body file. @param output  empty: the name of the file with the ending .h5
/// @param units  units of its numbers; empty: SI, or those that the file declares
void reduce_from(const std::string& path, std::string output, const std::string& units, const CommonOptions& common);

}  // namespace bielle::reduce
