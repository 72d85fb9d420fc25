#include "reduce/common/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>

namespace bielle {

namespace {

/// Owns one HDF5 identifier.
class Id {
 public:
  using Closer = herr_t (*)(hid_t);
  Id() = default;
  Id(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Id& operator=(Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  ~Id() {
    if (id_ >= 0) closer_(id_);
  }
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

Id text_type() {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Id dataspace(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> size(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose};
}

std::size_t count_of(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::string to_string(const Shape& shape) { return fmt::format("({})", fmt::join(shape, ", ")); }

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Calls action(first, rows) for blocks of rows of at most 4 MB, so that a large matrix is not held twice.
template <class Action>
void for_row_blocks(Eigen::Index rows, Eigen::Index columns, Action&& action) {
  if (columns == 0) return;
  const Eigen::Index most = std::max<Eigen::Index>(1, (Eigen::Index{1} << 19) / columns);
  for (Eigen::Index first = 0; first < rows; first += most) action(first, std::min(most, rows - first));
}

/// The part of a 2-d dataset's space that holds some of its rows.
Id rows_of(hid_t dataset, Eigen::Index first, Eigen::Index rows) {
  Id space(H5Dget_space(dataset), H5Sclose);
  hsize_t start[2] = {0, 0}, count[2] = {0, 0};
  H5Sget_simple_extent_dims(space, count, nullptr);
  start[0] = static_cast<hsize_t>(first);
  count[0] = static_cast<hsize_t>(rows);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr);
  return space;
}

/// Files whose format every HDF5 since 1.0 reads, and that stay readable when their writer is killed after a flush.
Id access_properties() {
  Id properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(properties, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  H5Pset_file_locking(properties, true, true);  // but go on where the file system knows no locks
  return properties;
}

/// A group that remembers the order in which its members were made.
Id group_properties(hid_t kind) {
  Id properties(H5Pcreate(kind), H5Pclose);
  H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return properties;
}

/// HDF5 prints its own errors on standard error unless told not to, by each thread.
void silence_hdf5() {
  thread_local const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static_cast<void>(silenced);
}

}  // namespace

/// A dataset to which rows are appended, kept open.
struct GrowingDataset {
  Id dataset;
  int rank = 0;
  std::array<hsize_t, H5S_MAX_RANK> extent{};  ///< now; extent[0] counts the rows
  std::size_t row_size = 1;
};

struct Hdf5File::Handle {
  std::string path;
  bool writing = false;
  Id file;
  std::map<std::string, GrowingDataset> growing;  // after `file`: closed before it

  [[noreturn]] void fail(const std::string& object, const std::string& what) const {
    const std::string message = fmt::format("{}: {}{}{}", path, object, object.empty() ? "" : ": ", what);
    if (writing) throw ComputationError(message);
    throw InputError(message);
  }
  /// The result of a call that returns a negative number on failure.
  template <class Result>
  Result checked(Result result, const std::string& object, const char* what) const {
    if (result < 0) fail(object, what);
    return result;
  }

  bool has(const std::string& object) const;
  Id open_object(const std::string& object) const;
  Id open_dataset(const std::string& dataset) const;
  void make_groups_above(const std::string& object) const;
  void write_text_attribute(hid_t object, const std::string& path, const std::string& name,
                            const std::string& value) const;
  void write_values(const std::string& dataset, hid_t memory_type, hid_t file_type, const void* values,
                    std::size_t count, const Shape& shape, const std::string& units,
                    const std::string& description) const;
  Id make_dataset(const std::string& dataset, hid_t file_type, const Shape& shape, const std::string& units,
                  const std::string& description) const;
  void describe(hid_t object, const std::string& dataset, const std::string& units,
                const std::string& description) const;
  Shape shape(hid_t dataset, const std::string& name) const;
  void check_class(hid_t dataset, const std::string& name, H5T_class_t expected) const;
  std::vector<std::string> read_strings(const std::string& dataset) const;
  GrowingDataset growing_from(Id dataset, const std::string& name) const;
};

bool Hdf5File::Handle::has(const std::string& object) const {
  if (object == "/") return true;
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const std::string part = object.substr(0, end);
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (H5Oexists_by_name(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

Id Hdf5File::Handle::open_object(const std::string& object) const {
  Id id(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!id.valid()) fail(object, "is not in this file");
  return id;
}

Id Hdf5File::Handle::open_dataset(const std::string& dataset) const {
  if (!has(dataset)) fail(dataset, "is not in this file");
  Id id(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (!id.valid()) fail(dataset, "is no dataset, or damaged");
  return id;
}

void Hdf5File::Handle::make_groups_above(const std::string& object) const {
  for (std::size_t end = object.find('/', 1); end != std::string::npos; end = object.find('/', end + 1)) {
    const std::string group = object.substr(0, end);
    if (has(group)) continue;
    const Id properties = group_properties(H5P_GROUP_CREATE);
    const Id made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
    if (!made.valid()) fail(group, "the group cannot be made");
  }
}

void Hdf5File::Handle::write_text_attribute(hid_t object, const std::string& path_of_object, const std::string& name,
                                            const std::string& value) const {
  const Id type = text_type(), space = dataspace({});
  if (H5Aexists(object, name.c_str()) > 0) H5Adelete(object, name.c_str());
  const Id attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* text = value.c_str();
  if (!attribute.valid() || H5Awrite(attribute, type, &text) < 0)
    fail(path_of_object, fmt::format("the attribute '{}' cannot be written", name));
}

void Hdf5File::Handle::describe(hid_t object, const std::string& dataset, const std::string& units,
                                const std::string& description) const {
  if (units.empty()) throw std::logic_error(fmt::format("the dataset '{}' has no units", dataset));
  write_text_attribute(object, dataset, "units", units);
  if (!description.empty()) write_text_attribute(object, dataset, "description", description);
}

void Hdf5File::Handle::write_values(const std::string& dataset, hid_t memory_type, hid_t file_type, const void* values,
                                    std::size_t count, const Shape& shape, const std::string& units,
                                    const std::string& description) const {
  if (count != count_of(shape))
    throw std::logic_error(fmt::format("{} values given for '{}' of shape {}", count, dataset, to_string(shape)));
  const Id made = make_dataset(dataset, file_type, shape, units, description);
  if (count > 0)
    checked(H5Dwrite(made, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), dataset,
            "cannot be written; is the disk full?");
}

Id Hdf5File::Handle::make_dataset(const std::string& dataset, hid_t file_type, const Shape& shape,
                                  const std::string& units, const std::string& description) const {
  make_groups_above(dataset);
  const Id space = dataspace(shape);
  Id made(H5Dcreate2(file, dataset.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (!made.valid()) fail(dataset, "cannot be made; is there one of that name already?");
  describe(made, dataset, units, description);
  return made;
}

Shape Hdf5File::Handle::shape(hid_t dataset, const std::string& name) const {
  const Id space(H5Dget_space(dataset), H5Sclose);
  const int rank = checked(H5Sget_simple_extent_ndims(space), name, "has no readable shape");
  std::vector<hsize_t> size(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return {size.begin(), size.end()};
}

void Hdf5File::Handle::check_class(hid_t dataset, const std::string& name, H5T_class_t expected) const {
  const Id type(H5Dget_type(dataset), H5Tclose);
  const H5T_class_t found = H5Tget_class(type);
  const bool number = found == H5T_FLOAT || found == H5T_INTEGER;
  if (expected == H5T_FLOAT ? number : found == expected) return;
  fail(name, expected == H5T_STRING    ? "expected text"
             : expected == H5T_INTEGER ? "expected integers"
                                       : "expected numbers");
}

std::vector<std::string> Hdf5File::Handle::read_strings(const std::string& dataset) const {
  const Id opened = open_dataset(dataset);
  check_class(opened, dataset, H5T_STRING);
  const std::size_t count = count_of(shape(opened, dataset));
  if (count == 0) return {};
  const Id stored(H5Dget_type(opened), H5Tclose);
  std::vector<std::string> result;
  if (H5Tis_variable_str(stored) > 0) {
    Id type(H5Tcopy(stored), H5Tclose);
    std::vector<char*> texts(count, nullptr);
    checked(H5Dread(opened, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()), dataset, "cannot be read");
    for (const char* text : texts) result.emplace_back(text == nullptr ? "" : text);
    const Id space(H5Dget_space(opened), H5Sclose);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, texts.data());
  } else {
    const std::size_t length = H5Tget_size(stored);
    std::vector<char> texts(count * length);
    checked(H5Dread(opened, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()), dataset, "cannot be read");
    for (std::size_t i = 0; i < count; ++i) {
      const std::string padded(texts.data() + i * length, length);
      result.emplace_back(padded.c_str());
    }
  }
  return result;
}

// -- the file

Hdf5File::Hdf5File(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() = default;

Hdf5File Hdf5File::create(const std::string& path) {
  silence_hdf5();
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  handle->writing = true;
  const Id creation = group_properties(H5P_FILE_CREATE), access = access_properties();
  handle->file = Id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  if (!handle->file.valid())
    handle->fail("", "cannot be created: is its folder there and writable, and no other program using the file?");
  return Hdf5File(std::move(handle));
}

Hdf5File Hdf5File::open(const std::string& path) {
  silence_hdf5();
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) handle->fail("", "there is no such file");
  if (std::filesystem::is_directory(path, error)) handle->fail("", "is a folder, expected a file");
  std::FILE* readable = std::fopen(path.c_str(), "rb");
  if (readable == nullptr) handle->fail("", "cannot be read; is reading permitted?");
  std::fclose(readable);
  if (H5Fis_hdf5(path.c_str()) == 0) handle->fail("", "is no HDF5 file");
  const Id access = access_properties();
  handle->file = Id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!handle->file.valid())
    handle->fail("", "cannot be opened: truncated, damaged, or being written by another program");
  return Hdf5File(std::move(handle));
}

Hdf5File Hdf5File::open_to_extend(const std::string& path) {
  { const Hdf5File readable = open(path); }
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  handle->writing = true;
  const Id access = access_properties();
  handle->file = Id(H5Fopen(path.c_str(), H5F_ACC_RDWR, access), H5Fclose);
  if (!handle->file.valid()) handle->fail("", "cannot be opened for writing");
  return Hdf5File(std::move(handle));
}

const std::string& Hdf5File::path() const { return handle_->path; }

void Hdf5File::flush() {
  silence_hdf5();
  handle_->checked(H5Fflush(handle_->file, H5F_SCOPE_LOCAL), "", "writing failed; is the disk full?");
}

void Hdf5File::close() {
  if (!handle_->file.valid()) return;
  if (handle_->writing) flush();
  handle_->growing.clear();
  handle_->file = Id();
}

// -- attributes

void Hdf5File::write_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Id opened = handle_->open_object(object);
  handle_->write_text_attribute(opened, object, name, value);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Id opened = handle_->open_object(object);
  Id attribute;
  // Overwriting in place, so that a killed writer leaves the old value or the new one.
  if (H5Aexists(opened, name.c_str()) > 0) {
    attribute = Id(H5Aopen(opened, name.c_str(), H5P_DEFAULT), H5Aclose);
  } else {
    const Id space = dataspace({});
    attribute = Id(H5Acreate2(opened, name.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  }
  if (!attribute.valid() || H5Awrite(attribute, H5T_NATIVE_INT64, &value) < 0)
    handle_->fail(object, fmt::format("the attribute '{}' cannot be written", name));
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  const Id opened = handle_->open_object(object);
  return H5Aexists(opened, name.c_str()) > 0;
}

std::string Hdf5File::read_text_attribute(const std::string& object, const std::string& name) const {
  const Id opened = handle_->open_object(object);
  const Id attribute(H5Aopen(opened, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) handle_->fail(object, fmt::format("has no attribute '{}'", name));
  const Id stored(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(stored) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
    handle_->fail(object, fmt::format("the attribute '{}' is no text", name));
  if (H5Tis_variable_str(stored) > 0) {
    char* text = nullptr;
    handle_->checked(H5Aread(attribute, stored, &text), object, "an attribute cannot be read");
    std::string result = text == nullptr ? "" : text;
    H5free_memory(text);
    return result;
  }
  std::vector<char> text(H5Tget_size(stored) + 1, '\0');
  handle_->checked(H5Aread(attribute, stored, text.data()), object, "an attribute cannot be read");
  return text.data();
}

std::int64_t Hdf5File::read_integer_attribute(const std::string& object, const std::string& name) const {
  const Id opened = handle_->open_object(object);
  const Id attribute(H5Aopen(opened, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) handle_->fail(object, fmt::format("has no attribute '{}'", name));
  const Id stored(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  std::int64_t value = 0;
  if (H5Tget_class(stored) != H5T_INTEGER || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0)
    handle_->fail(object, fmt::format("the attribute '{}' is no whole number", name));
  return value;
}

// -- whole datasets

void Hdf5File::write(const std::string& dataset, std::span<const double> values, const Shape& shape,
                     const std::string& units, const std::string& description) {
  handle_->write_values(dataset, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, values.data(), values.size(), shape, units,
                        description);
}

void Hdf5File::write(const std::string& dataset, std::span<const std::int64_t> values, const Shape& shape,
                     const std::string& units, const std::string& description) {
  handle_->write_values(dataset, H5T_NATIVE_INT64, H5T_STD_I64LE, values.data(), values.size(), shape, units,
                        description);
}

void Hdf5File::write(const std::string& dataset, const Eigen::MatrixXd& matrix, const std::string& units,
                     const std::string& description) {
  const Shape shape{static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())};
  const Id made = handle_->make_dataset(dataset, H5T_IEEE_F64LE, shape, units, description);
  for_row_blocks(matrix.rows(), matrix.cols(), [&](Eigen::Index first, Eigen::Index rows) {
    const RowMajor block = matrix.middleRows(first, rows);
    const Id space = rows_of(made, first, rows), memory = dataspace({static_cast<std::size_t>(rows), shape[1]});
    handle_->checked(H5Dwrite(made, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, block.data()), dataset,
                     "cannot be written; is the disk full?");
  });
}

void Hdf5File::write(const std::string& dataset, const Eigen::VectorXd& vector, const std::string& units,
                     const std::string& description) {
  const auto size = static_cast<std::size_t>(vector.size());
  write(dataset, {vector.data(), size}, {size}, units, description);
}

void Hdf5File::write(const std::string& dataset, double value, const std::string& units,
                     const std::string& description) {
  write(dataset, {&value, 1}, {}, units, description);
}

void Hdf5File::write_text(const std::string& dataset, const std::string& text) {
  const char* pointer = text.c_str();
  const Id type = text_type();
  handle_->write_values(dataset, type, type, &pointer, 1, {}, "-", "");
}

void Hdf5File::write_names(const std::string& dataset, const std::vector<std::string>& names) {
  std::vector<const char*> pointers;
  pointers.reserve(names.size());
  for (const std::string& name : names) pointers.push_back(name.c_str());
  const Id type = text_type();
  handle_->write_values(dataset, type, type, pointers.data(), pointers.size(), {names.size()}, "-", "");
}

bool Hdf5File::has(const std::string& object) const { return handle_->has(object); }

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
  const Id opened(H5Gopen2(handle_->file, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!opened.valid()) handle_->fail(group, "is no group of this file");
  const Id properties(H5Gget_create_plist(opened), H5Pclose);
  unsigned order = 0;
  H5Pget_link_creation_order(properties, &order);
  std::vector<std::string> names;
  const auto add_name = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  const H5_index_t index = (order & H5P_CRT_ORDER_TRACKED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
  handle_->checked(H5Literate(opened, index, H5_ITER_INC, nullptr, add_name, &names), group, "cannot be listed");
  return names;
}

Shape Hdf5File::shape(const std::string& dataset) const {
  const Id opened = handle_->open_dataset(dataset);
  return handle_->shape(opened, dataset);
}

std::string Hdf5File::units(const std::string& dataset) const { return read_text_attribute(dataset, "units"); }

std::vector<double> Hdf5File::read(const std::string& dataset) const {
  const Id opened = handle_->open_dataset(dataset);
  handle_->check_class(opened, dataset, H5T_FLOAT);
  std::vector<double> values(count_of(handle_->shape(opened, dataset)));
  if (!values.empty())
    handle_->checked(H5Dread(opened, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), dataset,
                     "cannot be read: the file is damaged");
  return values;
}

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& dataset) const {
  const Id opened = handle_->open_dataset(dataset);
  handle_->check_class(opened, dataset, H5T_INTEGER);
  std::vector<std::int64_t> values(count_of(handle_->shape(opened, dataset)));
  if (!values.empty())
    handle_->checked(H5Dread(opened, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), dataset,
                     "cannot be read: the file is damaged");
  return values;
}

Eigen::MatrixXd Hdf5File::read_matrix(const std::string& dataset) const {
  const Id opened = handle_->open_dataset(dataset);
  handle_->check_class(opened, dataset, H5T_FLOAT);
  const Shape size = handle_->shape(opened, dataset);
  if (size.size() != 2) handle_->fail(dataset, "expected a matrix, found the shape " + to_string(size));
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(size[0]), static_cast<Eigen::Index>(size[1]));
  for_row_blocks(matrix.rows(), matrix.cols(), [&](Eigen::Index first, Eigen::Index rows) {
    RowMajor block(rows, matrix.cols());
    const Id space = rows_of(opened, first, rows), memory = dataspace({static_cast<std::size_t>(rows), size[1]});
    handle_->checked(H5Dread(opened, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, block.data()), dataset,
                     "cannot be read: the file is damaged");
    matrix.middleRows(first, rows) = block;
  });
  return matrix;
}

Eigen::VectorXd Hdf5File::read_vector(const std::string& dataset) const {
  const Shape size = shape(dataset);
  if (size.size() != 1) handle_->fail(dataset, "expected a list of numbers, found the shape " + to_string(size));
  const std::vector<double> values = read(dataset);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

double Hdf5File::read_number(const std::string& dataset) const {
  const std::vector<double> values = read(dataset);
  if (values.size() != 1) handle_->fail(dataset, fmt::format("expected one number, found {}", values.size()));
  return values[0];
}

std::string Hdf5File::read_text(const std::string& dataset) const {
  const std::vector<std::string> texts = handle_->read_strings(dataset);
  if (texts.size() != 1) handle_->fail(dataset, fmt::format("expected one text, found {}", texts.size()));
  return texts[0];
}

std::vector<std::string> Hdf5File::read_names(const std::string& dataset) const {
  return handle_->read_strings(dataset);
}

// -- datasets that grow

void Hdf5File::create_rows(const std::string& dataset, const Shape& row_shape, const std::string& units,
                           const std::string& description, std::size_t rows_per_chunk) {
  std::vector<hsize_t> size{0};
  std::vector<hsize_t> most{H5S_UNLIMITED}, chunk{rows_per_chunk};
  for (const std::size_t extent : row_shape) {
    size.push_back(extent);
    most.push_back(extent);
    chunk.push_back(std::max<std::size_t>(extent, 1));
  }
  const Id space(H5Screate_simple(static_cast<int>(size.size()), size.data(), most.data()), H5Sclose);
  const Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
  // Without a chunk cache rows go to the file as they are written: a flush has nothing but the index to write.
  H5Pset_chunk_cache(access, 0, 0, 1);
  H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
  handle_->make_groups_above(dataset);
  Id made(H5Dcreate2(handle_->file, dataset.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, access), H5Dclose);
  if (!made.valid()) handle_->fail(dataset, "cannot be made; is there one of that name already?");
  handle_->describe(made, dataset, units, description);
  handle_->growing.insert_or_assign(dataset, handle_->growing_from(std::move(made), dataset));
}

GrowingDataset Hdf5File::Handle::growing_from(Id dataset, const std::string& name) const {
  const Shape size = shape(dataset, name);
  if (size.empty()) fail(name, "cannot grow");
  GrowingDataset result;
  result.dataset = std::move(dataset);
  result.rank = static_cast<int>(size.size());
  std::copy(size.begin(), size.end(), result.extent.begin());
  for (std::size_t i = 1; i < size.size(); ++i) result.row_size *= size[i];
  return result;
}

void Hdf5File::append_rows(const std::string& dataset, std::span<const double> values, std::size_t rows) {
  silence_hdf5();
  auto found = handle_->growing.find(dataset);
  if (found == handle_->growing.end())
    found = handle_->growing.emplace(dataset, handle_->growing_from(handle_->open_dataset(dataset), dataset)).first;
  GrowingDataset& growing = found->second;
  if (values.size() != rows * growing.row_size)
    throw std::logic_error(fmt::format("{} values given for {} rows of '{}'", values.size(), rows, dataset));
  if (rows == 0) return;
  std::array<hsize_t, H5S_MAX_RANK> start{}, block = growing.extent;
  start[0] = growing.extent[0];
  block[0] = rows;
  growing.extent[0] += rows;
  handle_->checked(H5Dset_extent(growing.dataset, growing.extent.data()), dataset, "cannot grow; is the disk full?");
  if (values.empty()) return;
  const Id memory(H5Screate_simple(growing.rank, block.data(), nullptr), H5Sclose);
  const Id space(H5Dget_space(growing.dataset), H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
  handle_->checked(H5Dwrite(growing.dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()), dataset,
                   "cannot be written; is the disk full?");
}

void Hdf5File::link(const std::string& target, const std::string& name) {
  handle_->make_groups_above(name);
  if (H5Lexists(handle_->file, name.c_str(), H5P_DEFAULT) > 0) remove(name);
  handle_->checked(H5Lcreate_soft(target.c_str(), handle_->file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name,
                   "the link cannot be made");
}

void Hdf5File::make_group(const std::string& group) { handle_->make_groups_above(group + "/"); }

void Hdf5File::remove(const std::string& object) {
  handle_->growing.erase(object);
  handle_->checked(H5Ldelete(handle_->file, object.c_str(), H5P_DEFAULT), object, "cannot be removed");
}

// -- files that appear when complete

AtomicOutput::AtomicOutput(std::string path) : path_(std::move(path)), temporary_path_(path_ + ".partial") {}

AtomicOutput::~AtomicOutput() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_path_, ignored);
}

void AtomicOutput::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_path_, path_, error);
  if (error)
    throw ComputationError(
        fmt::format("{}: cannot take its name from '{}': {}", path_, temporary_path_, error.message()));
  committed_ = true;
}

}  // namespace bielle
