// Matrices in the files of other programs: tools/bielle-exchange converts them to a matrix file in SI units.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "reduce/matrices/matrix_set.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// A quantity that a matrix of the file recovers.
struct MatrixQuantity {
  std::string matrix;  ///< its name in the file
  std::string kind;    ///< of its rows: "stress", "force"
};

/// The files that hold the matrices of a body.
struct ForeignMatrices {
  std::string path;                                  ///< file of both matrices, or of the stiffness; or a matrix file
  std::string mass;                                  ///< another file with the mass; empty: none
  std::string nodes;                                 ///< another file with the nodes (a deck, a table); empty: none
  std::string unknowns;                              ///< another file with the order of the unknowns; empty: none
  std::string format;                                ///< its name in tools/guide/exchange.md; empty: known by the file
  std::map<std::string, std::string> names;          ///< names of the matrices in the file: "stiffness" -> "KAAX"
  std::vector<std::int64_t> interfaces;              ///< numbers of nodes that become interfaces; empty: not told
  std::map<std::string, MatrixQuantity> quantities;  ///< recovered quantities by name
  std::string units;  ///< units of its numbers, "mm-t-s"; empty: SI, or those that the file declares
  /// Whether the requests are keys of a body file. Messages then name these keys instead of options.
  bool in_body_file = false;
};

/// Reads a matrix file, or converts another program's file to one. The converter's notes are shown.
/// @throws InputError with the converter's own sentence; ComputationError when there is no converter
MatrixSet read_foreign_matrices(const ForeignMatrices& request, Progress& progress);

}  // namespace bielle::reduce
