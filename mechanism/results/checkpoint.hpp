// Checkpoints of a results file, from which a run can be continued.
//
// A results file contains, under /checkpoints/analysis_k, one row of `state` per checkpoint and, written after it, the
// number of rows that the analysis had recorded, with a checksum of both and one of those rows: every checkpoint that
// is counted in `rows` is complete, even if the program crashes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bielle {
class Hdf5File;
}

namespace bielle::mechanism {

class Model;

struct Checkpoint {
  int analysis = 0;                           ///< number of the analysis from 1, as in /analysis_1
  std::size_t rows = 0;                       ///< number of its recorded rows
  std::vector<double> values;                 ///< values of the Archive
  std::optional<std::int64_t> rows_sum = {};  ///< ResultsStream::sum_of_rows; empty for older files
};

/// The fingerprint distinguishes models, in addition to the input that they were read from (model_difference.hpp). It
/// contains, one per line, the format of a checkpoint's numbers, the number of state variables of each kind, and
/// gravity, nodes and components in their order, with the size of their forces in a test state. A run can only be
/// continued with the same fingerprint.
std::string fingerprint(const Model& model);

/// Returns the last checkpoint of a results file.
/// @throws InputError if the file contains none, or belongs to another model or another version of the program
Checkpoint read_checkpoint(const std::string& results_path, const Model& model);

/// Appends a checkpoint; all rows that it counts must be in the file.
void append_checkpoint(Hdf5File& file, const Model& model, const Checkpoint& checkpoint);

/// Removes from the file everything that was written after the checkpoint.
void rewind_to(Hdf5File& file, const Checkpoint& checkpoint);

}  // namespace bielle::mechanism
