// Points of a results file from which a run can go on.
//
// A results file holds, under /checkpoints/analysis_k, one row of `state` per checkpoint and, written after it, the
// number of rows that the analysis had recorded, with a checksum of both and one of those rows: whatever happens to the
// program, every checkpoint that `rows` counts is whole.
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
  int analysis = 0;                           ///< 1-based, as in /analysis_1
  std::size_t rows = 0;                       ///< of its results that were recorded
  std::vector<double> values;                 ///< of the Archive
  std::optional<std::int64_t> rows_sum = {};  ///< ResultsStream::sum_of_rows; nothing in files of before
};

/// The fingerprint tells models apart, besides the input that they were read from (model_difference.hpp). It names, one
/// per line, the format of a checkpoint's numbers, how many of each kind the state has, and gravity, nodes and
/// components in their order, with the size of their forces in a probing state. A run can go on only with the same
/// fingerprint.
std::string fingerprint(const Model& model);

/// The last checkpoint of a results file.
/// @throws InputError when the file holds none, or is of another model or another version of the program
Checkpoint read_checkpoint(const std::string& results_path, const Model& model);

/// Adds a checkpoint; all rows that it counts are in the file.
void append_checkpoint(Hdf5File& file, const Model& model, const Checkpoint& checkpoint);

/// Takes out of the file what came after the checkpoint.
void rewind_to(Hdf5File& file, const Checkpoint& checkpoint);

}  // namespace bielle::mechanism
