// Implementation of Hdf5File: identifiers that close themselves, and functions that its source files share. Other files
// do not include it.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <hdf5.h>

#include "reduce/common/files/hdf5_file.hpp"

namespace bielle {

/// Owns one HDF5 identifier.
class Hdf5Id {
 public:
  using Closer = herr_t (*)(hid_t);
  Hdf5Id() = default;
  Hdf5Id(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  Hdf5Id(const Hdf5Id&) = delete;
  Hdf5Id& operator=(const Hdf5Id&) = delete;
  ~Hdf5Id() {
    if (id_ >= 0) closer_(id_);
  }
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

/// Text of variable length in UTF-8.
Hdf5Id hdf5_text_type();
/// Makes a dataspace of fixed size; a scalar for an empty shape.
Hdf5Id hdf5_space(const Shape& shape);
std::size_t count_of(const Shape& shape);   ///< number of values; the largest possible number if there are more
std::string to_string(const Shape& shape);  ///< "(2, 3)"
/// Makes properties of a file or group that keeps the order in which its members are created.
/// @param kind  H5P_FILE_CREATE or H5P_GROUP_CREATE
Hdf5Id ordered_group_properties(hid_t kind);
/// Makes properties of a dataset. Like groups, datasets hold no dates: equal content makes equal files.
Hdf5Id dataset_properties();
/// Makes properties of a transfer of `count` texts: its buffer for conversion is as large as they need. HDF5's default
/// clears a megabyte each time.
Hdf5Id text_transfer_properties(std::size_t count);
/// Makes the properties with which files are opened: their format can be read by every HDF5 since 1.8, and stays
/// readable if the writer is killed after a flush.
Hdf5Id access_properties();
/// Stops HDF5 from printing its own errors on standard error. It is called in each thread.
void silence_hdf5();

/// A dataset to which rows are appended, kept open.
struct GrowingDataset {
  Hdf5Id dataset;
  int rank = 0;
  std::array<hsize_t, H5S_MAX_RANK> extent{};  ///< current shape; extent[0] counts the rows
  std::size_t row_size = 1;
};

/// The dataspace and the properties of new datasets that grow. They are made once for all datasets of a shape, because
/// HDF5 copies whole properties whenever one of them is set.
struct RowsTemplate {
  Hdf5Id space, creation, access;
};

struct Hdf5File::Handle {
  std::string path;
  std::string base;  ///< group at which all paths start: "" or "/pieces/2"
  bool writing = false;
  Hdf5Id file;
  std::map<std::string, GrowingDataset> growing;  // after `file`: closed before it
  mutable std::set<std::string> known_groups;     ///< groups that were found or made, by their paths in the file
  std::map<std::vector<hsize_t>, RowsTemplate> templates;  ///< by the shape of the rows of a chunk
  const Hdf5Id text_type = hdf5_text_type(), scalar = hdf5_space({});

  [[noreturn]] void fail(const std::string& object, const std::string& what) const {
    const std::string message = fmt::format("{}: {}{}{}", path, at(object), object.empty() ? "" : ": ", what);
    if (writing) throw ComputationError(message);
    throw InputError(message);
  }
  /// Returns the result of a call that returns a negative number on failure.
  template <class Result>
  Result checked(Result result, const std::string& object, const char* what) const {
    if (result < 0) fail(object, what);
    return result;
  }

  /// Returns the path of an object in the file.
  std::string at(const std::string& object) const {
    if (object.empty() || base.empty()) return object;
    return object == "/" ? base : base + object;
  }
  bool has(const std::string& object) const;
  bool exists(const std::string& path_in_file) const;
  Hdf5Id open_object(const std::string& object) const;
  Hdf5Id open_dataset(const std::string& dataset) const;
  void make_groups_above(const std::string& object) const;
  const RowsTemplate& rows_template(const Shape& row_shape, std::size_t rows_per_chunk);
  /// Adds an attribute that the object does not have yet.
  void add_text_attribute(hid_t object, const std::string& path, const std::string& name,
                          const std::string& value) const;
  void write_values(const std::string& dataset, hid_t memory_type, hid_t file_type, const void* values,
                    std::size_t count, const Shape& shape, const std::string& units, const std::string& description,
                    hid_t transfer = H5P_DEFAULT) const;
  Hdf5Id make_dataset(const std::string& dataset, hid_t file_type, const Shape& shape, const std::string& units,
                      const std::string& description) const;
  void describe(hid_t object, const std::string& dataset, const std::string& units,
                const std::string& description) const;
  Shape shape(hid_t dataset, const std::string& name) const;
  void check_class(hid_t dataset, const std::string& name, H5T_class_t expected) const;
  std::vector<std::string> read_strings(const std::string& dataset) const;
  /// Returns the number of values in a dataset. Throws if the file is far too small for them.
  std::size_t stored_count(hid_t dataset, const std::string& name) const;
  GrowingDataset growing_from(Hdf5Id dataset, const std::string& name) const;
  GrowingDataset& growing_dataset(const std::string& dataset);  // opens the dataset unless it is open
};

}  // namespace bielle
