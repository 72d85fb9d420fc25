#include "reduce/common/files/hdf5_file.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "reduce/common/counted.hpp"
#include "reduce/common/files/file_checks.hpp"
#include "reduce/common/files/hdf5_handle.hpp"
#include "reduce/common/files/hdf5_soundness.hpp"

namespace bielle {

Hdf5File::Hdf5File(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() = default;

Hdf5File Hdf5File::create(const std::string& path) {
  silence_hdf5();
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  handle->writing = true;
  const Hdf5Id creation = ordered_group_properties(H5P_FILE_CREATE), access = access_properties();
  // Datasets have few chunks. By default a node of their index has room for 64 of them and takes 20 kB of memory.
  H5Pset_istore_k(creation, 2);
  // A writer may be killed while it links results from the root. The links of the root stand in its header, which has
  // room for them from the start and is written as a whole; by default nine links move to another structure.
  constexpr unsigned root_links = 64, length_of_name = 16;
  H5Pset_link_phase_change(creation, root_links, root_links / 2);
  H5Pset_est_link_info(creation, root_links / 2, length_of_name);
  handle->file = Hdf5Id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  if (!handle->file.valid())
    handle->fail(
        "",
        "cannot be created: is its folder there and writable, the disk not full, and no other program using the file?");
  return Hdf5File(std::move(handle));
}

Hdf5File Hdf5File::open(const std::string& path) {
  silence_hdf5();
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  check_input_file(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) handle->fail("", "is a pipe, expected a file");
  std::FILE* readable = std::fopen(path.c_str(), "rb");
  if (readable == nullptr) handle->fail("", "cannot be read; is reading permitted?");
  std::fclose(readable);
  if (H5Fis_hdf5(path.c_str()) == 0) handle->fail("", "is no HDF5 file");
  check_sound(path);
  const Hdf5Id access = access_properties();
  handle->file = Hdf5Id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!handle->file.valid())
    handle->fail("", "cannot be opened: truncated, damaged, or being written by another program");
  return Hdf5File(std::move(handle));
}

bool Hdf5File::begins_like_one(const std::string& path) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::string head(signature.size(), '\0');
  std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == signature;
}

Hdf5File Hdf5File::open_to_extend(const std::string& path) {
  { const Hdf5File readable = open(path); }
  auto handle = std::make_unique<Handle>();
  handle->path = path;
  handle->writing = true;
  const Hdf5Id access = access_properties();
  handle->file = Hdf5Id(H5Fopen(path.c_str(), H5F_ACC_RDWR, access), H5Fclose);
  if (!handle->file.valid()) handle->fail("", "cannot be opened for writing");
  return Hdf5File(std::move(handle));
}

const std::string& Hdf5File::path() const { return handle_->path; }

void Hdf5File::enter(const std::string& group) { handle_->base = group == "/" ? "" : group; }

std::string Hdf5File::place() const { return handle_->path + (handle_->base.empty() ? "" : ": " + handle_->base); }

void Hdf5File::flush() {
  silence_hdf5();
  handle_->checked(H5Fflush(handle_->file, H5F_SCOPE_LOCAL), "", "writing failed; is the disk full?");
}

void Hdf5File::hold_back(bool held) {
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  handle_->checked(H5Fget_mdc_config(handle_->file, &cache), "", "the cache cannot be set");
  // HDF5 keeps all metadata in the cache only if the size of the cache does not adapt to its use.
  cache.evictions_enabled = !held;
  cache.incr_mode = held ? H5C_incr__off : H5C_incr__threshold;
  cache.flash_incr_mode = held ? H5C_flash_incr__off : H5C_flash_incr__add_space;
  cache.decr_mode = held ? H5C_decr__off : H5C_decr__age_out_with_threshold;
  handle_->checked(H5Fset_mdc_config(handle_->file, &cache), "", "the cache cannot be set");
}

void Hdf5File::close() {
  if (!handle_->file.valid()) return;
  if (handle_->writing) flush();
  handle_->growing.clear();
  handle_->file = Hdf5Id();
}

// -- attributes

void Hdf5File::write_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Hdf5Id opened = handle_->open_object(object);
  if (H5Aexists(opened, name.c_str()) > 0) H5Adelete(opened, name.c_str());
  handle_->add_text_attribute(opened, object, name, value);
}

void Hdf5File::write_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Hdf5Id opened = handle_->open_object(object);
  Hdf5Id attribute;
  // The attribute is overwritten in place, so that a killed writer leaves the old value or the new one.
  if (H5Aexists(opened, name.c_str()) > 0) {
    attribute = Hdf5Id(H5Aopen(opened, name.c_str(), H5P_DEFAULT), H5Aclose);
  } else {
    const Hdf5Id space = hdf5_space({});
    attribute = Hdf5Id(H5Acreate2(opened, name.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  }
  if (!attribute.valid() || H5Awrite(attribute, H5T_NATIVE_INT64, &value) < 0)
    handle_->fail(object, fmt::format("the attribute '{}' cannot be written", name));
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Id opened = handle_->open_object(object);
  return H5Aexists(opened, name.c_str()) > 0;
}

std::string Hdf5File::read_text_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Id opened = handle_->open_object(object);
  const Hdf5Id attribute(H5Aopen(opened, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) handle_->fail(object, fmt::format("has no attribute '{}'", name));
  const Hdf5Id stored(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
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
  const Hdf5Id opened = handle_->open_object(object);
  const Hdf5Id attribute(H5Aopen(opened, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) handle_->fail(object, fmt::format("has no attribute '{}'", name));
  const Hdf5Id stored(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  std::int64_t value = 0;
  if (H5Tget_class(stored) != H5T_INTEGER || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0)
    handle_->fail(object, fmt::format("the attribute '{}' is no whole number", name));
  return value;
}

// -- datasets that grow

const RowsTemplate& Hdf5File::Handle::rows_template(const Shape& row_shape, std::size_t rows_per_chunk) {
  std::vector<hsize_t> size{rows_per_chunk};
  size.insert(size.end(), row_shape.begin(), row_shape.end());
  RowsTemplate& made = templates[size];
  if (made.creation.valid()) return made;
  std::vector<hsize_t> chunk = size, most = size;
  for (hsize_t& extent : chunk) extent = std::max<hsize_t>(extent, 1);
  size[0] = 0;
  most[0] = H5S_UNLIMITED;
  const int rank = static_cast<int>(size.size());
  made.space = Hdf5Id(H5Screate_simple(rank, size.data(), most.data()), H5Sclose);
  made.creation = dataset_properties();
  H5Pset_chunk(made.creation, rank, chunk.data());
  H5Pset_fill_time(made.creation, H5D_FILL_TIME_NEVER);
  // Without a chunk cache rows are written to the file at once, and a flush only has to write the index.
  made.access = Hdf5Id(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(made.access, 0, 0, 1);
  return made;
}

void Hdf5File::create_rows(const std::string& dataset, const Shape& row_shape, const std::string& units,
                           const std::string& description, std::size_t rows_per_chunk) {
  const RowsTemplate& rows = handle_->rows_template(row_shape, rows_per_chunk);
  handle_->make_groups_above(dataset);
  Hdf5Id made(H5Dcreate2(handle_->file, handle_->at(dataset).c_str(), H5T_IEEE_F64LE, rows.space, H5P_DEFAULT,
                         rows.creation, rows.access),
              H5Dclose);
  if (!made.valid()) handle_->fail(dataset, "cannot be made; is there one of that name already?");
  handle_->describe(made, dataset, units, description);
  handle_->growing.insert_or_assign(handle_->at(dataset), handle_->growing_from(std::move(made), dataset));
}

GrowingDataset Hdf5File::Handle::growing_from(Hdf5Id dataset, const std::string& name) const {
  const Shape size = shape(dataset, name);
  if (size.empty()) fail(name, "cannot grow");
  GrowingDataset result;
  result.dataset = std::move(dataset);
  result.rank = static_cast<int>(size.size());
  std::copy(size.begin(), size.end(), result.extent.begin());
  for (std::size_t i = 1; i < size.size(); ++i) result.row_size *= size[i];
  return result;
}

GrowingDataset& Hdf5File::Handle::growing_dataset(const std::string& dataset) {
  silence_hdf5();
  auto found = growing.find(at(dataset));
  if (found == growing.end()) found = growing.emplace(at(dataset), growing_from(open_dataset(dataset), dataset)).first;
  return found->second;
}

void Hdf5File::truncate_rows(const std::string& dataset, std::size_t rows) {
  GrowingDataset& growing = handle_->growing_dataset(dataset);
  if (growing.extent[0] <= rows) return;
  growing.extent[0] = rows;
  handle_->checked(H5Dset_extent(growing.dataset, growing.extent.data()), dataset, "cannot be shortened");
}

void Hdf5File::append_rows(const std::string& dataset, std::span<const double> values, std::size_t rows) {
  GrowingDataset& growing = handle_->growing_dataset(dataset);
  if (values.size() != rows * growing.row_size)
    throw std::logic_error(
        fmt::format("{} given for {} of '{}'", counted(values.size(), "value"), counted(rows, "row"), dataset));
  if (rows == 0) return;
  std::array<hsize_t, H5S_MAX_RANK> start{}, block = growing.extent;
  start[0] = growing.extent[0];
  block[0] = rows;
  growing.extent[0] += rows;
  handle_->checked(H5Dset_extent(growing.dataset, growing.extent.data()), dataset, "cannot grow; is the disk full?");
  if (values.empty()) return;
  const Hdf5Id memory(H5Screate_simple(growing.rank, block.data(), nullptr), H5Sclose);
  const Hdf5Id space(H5Dget_space(growing.dataset), H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
  handle_->checked(H5Dwrite(growing.dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()), dataset,
                   "cannot be written; is the disk full?");
}

void Hdf5File::close_rows(const std::string& dataset) { handle_->growing.erase(handle_->at(dataset)); }

void Hdf5File::link(const std::string& target, const std::string& name) {
  handle_->make_groups_above(name);
  const std::string place = handle_->at(name);
  if (H5Lexists(handle_->file, place.c_str(), H5P_DEFAULT) > 0) remove(name);
  handle_->checked(H5Lcreate_soft(handle_->at(target).c_str(), handle_->file, place.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                   name, "the link cannot be made");
}

void Hdf5File::make_group(const std::string& group) { handle_->make_groups_above(group + "/"); }

void Hdf5File::remove(const std::string& object) {
  const std::string place = handle_->at(object);
  handle_->growing.erase(place);
  handle_->known_groups.clear();
  handle_->checked(H5Ldelete(handle_->file, place.c_str(), H5P_DEFAULT), object, "cannot be removed");
}

}  // namespace bielle
