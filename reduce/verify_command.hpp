// The command `bielle-reduce --verify`: the proof of a superelement or of the matrices of another program.
#pragma once

#include <optional>
#include <string>

#include "reduce/common/command_line.hpp"

namespace bielle::reduce {

struct VerifyRequest {
  std::string path;                    ///< a superelement, a matrix file, or a file of another program
  std::optional<std::string> against;  ///< another one of the same body
  std::string units;                   ///< units of the files that declare none: "mm-t-s"; empty: SI
};

/// Prints the report on standard output.
/// @returns whether all checks passed
/// @throws InputError if a file is none of these
bool verify_file(const VerifyRequest& request, const CommonOptions& common);

}  // namespace bielle::reduce
