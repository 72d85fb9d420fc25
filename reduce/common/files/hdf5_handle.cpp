#include "reduce/common/files/hdf5_handle.hpp"

#include <algorithm>
#include <limits>

#include "reduce/common/counted.hpp"

namespace bielle {

Hdf5Id hdf5_text_type() {
  Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Hdf5Id hdf5_space(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> size(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose};
}

std::size_t count_of(const Shape& shape) {
  std::size_t count = 1;
  for (const std::size_t extent : shape)
    if (__builtin_mul_overflow(count, extent, &count)) return std::numeric_limits<std::size_t>::max();
  return count;
}

std::string to_string(const Shape& shape) { return fmt::format("({})", fmt::join(shape, ", ")); }

Hdf5Id ordered_group_properties(hid_t kind) {
  Hdf5Id properties(H5Pcreate(kind), H5Pclose);
  H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

Hdf5Id dataset_properties() {
  Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

Hdf5Id text_transfer_properties(std::size_t count) {
  constexpr std::size_t least = 4096, most = 1 << 20;
  Hdf5Id properties(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_buffer(properties, std::clamp(count * sizeof(hvl_t), least, most), nullptr, nullptr);
  return properties;
}

Hdf5Id access_properties() {
  Hdf5Id properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(properties, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  H5Pset_file_locking(properties, true, true);  // the file is opened without a lock if the file system has no locks
  return properties;
}

void silence_hdf5() {
  // HDF5 1.10 crashes at exit if a file could not be closed because the disk is full. Bielle's files are closed by
  // their owners.
  static const herr_t no_clearing_at_exit = H5dont_atexit();
  static_cast<void>(no_clearing_at_exit);
  thread_local const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static_cast<void>(silenced);
}

bool Hdf5File::Handle::has(const std::string& object) const { return exists(at(object)); }

bool Hdf5File::Handle::exists(const std::string& path_in_file) const {
  if (path_in_file == "/") return true;
  for (std::size_t end = path_in_file.find('/', 1);; end = path_in_file.find('/', end + 1)) {
    const std::string part = path_in_file.substr(0, end);
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (H5Oexists_by_name(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

Hdf5Id Hdf5File::Handle::open_object(const std::string& object) const {
  Hdf5Id id(H5Oopen(file, at(object).c_str(), H5P_DEFAULT), H5Oclose);
  if (!id.valid()) fail(object, "is not in this file");
  return id;
}

Hdf5Id Hdf5File::Handle::open_dataset(const std::string& dataset) const {
  if (!has(dataset)) fail(dataset, "is not in this file");
  Hdf5Id id(H5Dopen2(file, at(dataset).c_str(), H5P_DEFAULT), H5Dclose);
  if (!id.valid()) fail(dataset, "is no dataset, or damaged");
  return id;
}

void Hdf5File::Handle::make_groups_above(const std::string& object) const {
  const std::string whole = at(object);
  for (std::size_t end = whole.find('/', 1); end != std::string::npos; end = whole.find('/', end + 1)) {
    const std::string group = whole.substr(0, end);
    if (known_groups.contains(group)) continue;
    if (exists(group)) {
      known_groups.insert(group);
      continue;
    }
    const Hdf5Id properties = ordered_group_properties(H5P_GROUP_CREATE);
    const Hdf5Id made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
    if (!made.valid()) fail(object, fmt::format("the group '{}' cannot be made", group));
    known_groups.insert(group);
  }
}

void Hdf5File::Handle::add_text_attribute(hid_t object, const std::string& path_of_object, const std::string& name,
                                          const std::string& value) const {
  const Hdf5Id attribute(H5Acreate2(object, name.c_str(), text_type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* text = value.c_str();
  if (!attribute.valid() || H5Awrite(attribute, text_type, &text) < 0)
    fail(path_of_object, fmt::format("the attribute '{}' cannot be written", name));
}

void Hdf5File::Handle::describe(hid_t object, const std::string& dataset, const std::string& units,
                                const std::string& description) const {
  if (units.empty()) throw std::logic_error(fmt::format("the dataset '{}' has no units", dataset));
  add_text_attribute(object, dataset, "units", units);
  if (!description.empty()) add_text_attribute(object, dataset, "description", description);
}

void Hdf5File::Handle::write_values(const std::string& dataset, hid_t memory_type, hid_t file_type, const void* values,
                                    std::size_t count, const Shape& shape, const std::string& units,
                                    const std::string& description, hid_t transfer) const {
  if (count != count_of(shape))
    throw std::logic_error(
        fmt::format("{} given for '{}' of shape {}", counted(count, "value"), dataset, to_string(shape)));
  const Hdf5Id made = make_dataset(dataset, file_type, shape, units, description);
  if (count > 0)
    checked(H5Dwrite(made, memory_type, H5S_ALL, H5S_ALL, transfer, values), dataset,
            "cannot be written; is the disk full?");
}

Hdf5Id Hdf5File::Handle::make_dataset(const std::string& dataset, hid_t file_type, const Shape& shape,
                                      const std::string& units, const std::string& description) const {
  make_groups_above(dataset);
  const Hdf5Id space = hdf5_space(shape), creation = dataset_properties();
  Hdf5Id made(H5Dcreate2(file, at(dataset).c_str(), file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  if (!made.valid()) fail(dataset, "cannot be made; is there one of that name already?");
  describe(made, dataset, units, description);
  return made;
}

Shape Hdf5File::Handle::shape(hid_t dataset, const std::string& name) const {
  const Hdf5Id space(H5Dget_space(dataset), H5Sclose);
  const int rank = checked(H5Sget_simple_extent_ndims(space), name, "has no readable shape");
  std::vector<hsize_t> size(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return {size.begin(), size.end()};
}

std::size_t Hdf5File::Handle::stored_count(hid_t dataset, const std::string& name) const {
  const std::size_t count = count_of(shape(dataset, name));
  const Hdf5Id type(H5Dget_type(dataset), H5Tclose);
  // Deflate compresses by a factor of at most 1032; parts that were never written take no space.
  constexpr double densest = 1100, never_written = 1 << 20;
  const double bytes = static_cast<double>(count) * static_cast<double>(H5Tget_size(type));
  if (bytes > densest * static_cast<double>(H5Dget_storage_size(dataset)) + never_written)
    fail(name, fmt::format("the shape {} is larger than the file: it is damaged", to_string(shape(dataset, name))));
  return count;
}

void Hdf5File::Handle::check_class(hid_t dataset, const std::string& name, H5T_class_t expected) const {
  const Hdf5Id type(H5Dget_type(dataset), H5Tclose);
  const H5T_class_t found = H5Tget_class(type);
  const bool number = found == H5T_FLOAT || found == H5T_INTEGER;
  if (expected == H5T_FLOAT ? number : found == expected) return;
  fail(name, expected == H5T_STRING    ? "expected text"
             : expected == H5T_INTEGER ? "expected integers"
                                       : "expected numbers");
}

std::vector<std::string> Hdf5File::Handle::read_strings(const std::string& dataset) const {
  const Hdf5Id opened = open_dataset(dataset);
  check_class(opened, dataset, H5T_STRING);
  const std::size_t count = stored_count(opened, dataset);
  if (count == 0) return {};
  const Hdf5Id stored(H5Dget_type(opened), H5Tclose);
  std::vector<std::string> result;
  if (H5Tis_variable_str(stored) > 0) {
    Hdf5Id type(H5Tcopy(stored), H5Tclose);
    std::vector<char*> texts(count, nullptr);
    checked(H5Dread(opened, type, H5S_ALL, H5S_ALL, text_transfer_properties(count), texts.data()), dataset,
            "cannot be read");
    for (const char* text : texts) result.emplace_back(text == nullptr ? "" : text);
    const Hdf5Id space(H5Dget_space(opened), H5Sclose);
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

}  // namespace bielle
