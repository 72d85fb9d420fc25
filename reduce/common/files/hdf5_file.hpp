// HDF5 files that hold real matrices, names and text; every dataset has units.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/common/error.hpp"

namespace bielle {

/// Shape of a dataset, slowest index first (C order, as HDF5 and numpy see it).
using Shape = std::vector<std::size_t>;

/// Encodes '/' and '.', which have a meaning in HDF5 paths, and '%' in names chosen by users as %2F, %2E and %25.
std::string link_name(const std::string& name);
std::string name_of_link(const std::string& link);

/// An open HDF5 file. Objects are addressed by absolute paths ("/reduced/stiffness"); missing groups are created.
///
/// A dataset cannot be written without its units ("-" for pure numbers). Long text is a dataset, since attributes over
/// 64 kB fail. Files have the earliest format, so that a file is readable after its writer was killed if it was flushed
/// before. Every failure is an InputError (reading) or ComputationError (writing) that names file and dataset.
class Hdf5File {
 public:
  static Hdf5File create(const std::string& path);  ///< replaces an existing file
  static Hdf5File open(const std::string& path);    ///< to read. @throws InputError: missing, truncated, no HDF5
  /// Tells whether the first bytes are those of an HDF5 file, even if hardly anything follows.
  static bool begins_like_one(const std::string& path);
  static Hdf5File open_to_extend(const std::string& path);  ///< Tells whether a file begins with the signature of HDF5,
                                                            ///< even if it is otherwise incomplete.
  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;
  ~Hdf5File();

  const std::string& path() const;
  /// Makes paths start at this group instead of the root ("/" leads back), so that functions that read or write a whole
  /// file can read or write a part of one.
  void enter(const std::string& group);
  std::string place() const;  ///< file and entered group, for messages
  void flush();
  /// Keeps the metadata of groups and datasets in memory until the next flush. If a writer is killed while it creates
  /// many of them, the file does not contain any of these.
  void hold_back(bool held);
  void close();  ///< @throws ComputationError when the disk is full etc.; the destructor closes silently

  // -- attributes of a group or dataset ("/" is the root)
  void write_attribute(const std::string& object, const std::string& name, const std::string& value);
  void write_attribute(const std::string& object, const std::string& name, std::int64_t value);
  std::string read_text_attribute(const std::string& object, const std::string& name) const;
  std::int64_t read_integer_attribute(const std::string& object, const std::string& name) const;
  bool has_attribute(const std::string& object, const std::string& name) const;

  // -- whole datasets. Matrices appear in the file as (rows, cols), whatever their storage order in memory.
  void write(const std::string& dataset, std::span<const double> values, const Shape& shape, const std::string& units,
             const std::string& description = "");
  void write(const std::string& dataset, std::span<const std::int64_t> values, const Shape& shape,
             const std::string& units, const std::string& description = "");
  void write(const std::string& dataset, const Eigen::MatrixXd& matrix, const std::string& units,
             const std::string& description = "");
  void write(const std::string& dataset, const Eigen::VectorXd& vector, const std::string& units,
             const std::string& description = "");
  void write(const std::string& dataset, double value, const std::string& units, const std::string& description = "");
  /// Numbers of 32 bits, for large meshes that are only drawn.
  void write_floats(const std::string& dataset, std::span<const float> values, const Shape& shape,
                    const std::string& units, const std::string& description = "");
  void write_indices(const std::string& dataset, std::span<const std::int32_t> values, const Shape& shape,
                     const std::string& description = "");
  void write_text(const std::string& dataset, const std::string& text);
  void write_names(const std::string& dataset, const std::vector<std::string>& names);  ///< variable-length UTF-8

  void make_group(const std::string& group);  ///< makes the group and those above it; an existing group stays as it is
  void remove(const std::string& object);     ///< takes a dataset, group or link out of the file

  bool has(const std::string& object) const;
  bool is_group(const std::string& object) const;
  bool is_text(const std::string& dataset) const;                     ///< texts or names
  bool grows(const std::string& dataset) const;                       ///< made by create_rows
  std::vector<std::string> names_in(const std::string& group) const;  ///< names of its groups and datasets, in file
                                                                      ///< order
  Shape shape(const std::string& dataset) const;
  std::string units(const std::string& dataset) const;
  std::vector<double> read(const std::string& dataset) const;
  std::vector<std::int64_t> read_integers(const std::string& dataset) const;
  Eigen::MatrixXd read_matrix(const std::string& dataset) const;  ///< reads a 2-d dataset
  Eigen::VectorXd read_vector(const std::string& dataset) const;  ///< reads a 1-d dataset
  double read_number(const std::string& dataset) const;
  std::string read_text(const std::string& dataset) const;
  std::vector<std::string> read_names(const std::string& dataset) const;

  // -- datasets that grow row by row (results)
  /// A dataset of shape (0, row_shape...) to be extended along its first index. Rows are written to the file as they
  /// are appended; a flush makes them visible.
  /// @param rows_per_chunk  number of rows that are stored together: the file grows by this number. When a dataset
  ///        grows, several places of the file change; a writer that is killed between these changes, within some 0.1
  ///        ms, leaves a dataset whose newest chunk cannot be read. If rows must survive, make chunks large: unfilled
  ///        parts take no space on the disk.
  void create_rows(const std::string& dataset, const Shape& row_shape, const std::string& units,
                   const std::string& description = "", std::size_t rows_per_chunk = 256);
  /// Appends `rows` rows; `values` holds them one after the other.
  void append_rows(const std::string& dataset, std::span<const double> values, std::size_t rows = 1);
  /// Frees the memory that a dataset takes since rows were appended; appending opens it again.
  void close_rows(const std::string& dataset);
  /// Reads `count` rows from number `first` on, one after the other, from a dataset that grows.
  std::vector<double> read_rows(const std::string& dataset, std::size_t first, std::size_t count) const;
  /// Removes the rows after the first `rows`, if there are more.
  void truncate_rows(const std::string& dataset, std::size_t rows);
  /// Makes `name` another name of `target` within this file (a soft link) and replaces an earlier link of that name.
  void link(const std::string& target, const std::string& name);

 private:
  struct Handle;
  explicit Hdf5File(std::unique_ptr<Handle> handle);
  std::unique_ptr<Handle> handle_;
};

}  // namespace bielle
