// The datasets of an analysis in a results file, in either layout (mechanism/io/README.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/results/result_sink.hpp"
#include "mechanism/results/results_rows.hpp"

namespace bielle {
class Hdf5File;
}

namespace bielle::mechanism {

/// The layout for a model: that which is asked for, or by names where there are not too many of them.
ResultsLayout layout_for(const ResultsRows& rows, std::optional<ResultsLayout> wanted);

/// Makes the datasets that grow, `columns`, and what says whose they are.
/// @param group  of the analysis @param rows_per_chunk  see Hdf5File::create_rows
void create_datasets(Hdf5File& file, const std::string& group, const ResultsRows& rows, ResultsLayout layout,
                     const std::vector<ResultsColumn>& columns, std::size_t rows_per_chunk);

/// Checks that an analysis of the file holds what would be recorded now, and nothing else.
/// @throws InputError
void check_same_datasets(const Hdf5File& file, const std::string& group, const Model& model, const ResultsRows& rows,
                         ResultsLayout layout, const std::vector<ResultsColumn>& columns);

/// Writes a number of each of some entries.
void write_numbers(Hdf5File& file, const std::string& group, const ResultsKinds& kinds, ResultsLayout layout,
                   const EntryNumbers& numbers);

}  // namespace bielle::mechanism
