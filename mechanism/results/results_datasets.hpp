// The datasets of an analysis in a results file, in both layouts (mechanism/io/README.md).
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

/// Returns the layout for a model: the requested one, otherwise the layout by names if it has not too many datasets.
ResultsLayout layout_for(const ResultsRows& rows, std::optional<ResultsLayout> wanted);

/// Creates the dataset of a column, which grows.
/// @param group  group of the analysis @param rows_per_chunk  see Hdf5File::create_rows
void create_dataset(Hdf5File& file, const std::string& group, const ResultsColumn& column, std::size_t rows_per_chunk);
/// Creates the groups of all entries, after their datasets, with their attributes.
void describe_entries(Hdf5File& file, const std::string& group, const ResultsRows& rows, ResultsLayout layout);

/// Checks that an analysis of the file contains the datasets that would be recorded now, and no others.
/// @throws InputError
void check_same_datasets(const Hdf5File& file, const std::string& group, const Model& model, const ResultsRows& rows,
                         ResultsLayout layout, const std::vector<ResultsColumn>& columns);

/// Writes a number for each of several entries.
void write_numbers(Hdf5File& file, const std::string& group, const ResultsKinds& kinds, ResultsLayout layout,
                   const EntryNumbers& numbers);

}  // namespace bielle::mechanism
