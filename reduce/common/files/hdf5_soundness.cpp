#include "reduce/common/files/hdf5_soundness.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>
#include <sys/stat.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/byte_sum.hpp"
#include "reduce/common/files/hdf5_handle.hpp"
#include "reduce/common/process/child_process.hpp"

namespace bielle {

namespace {

/// Returns the limits of the check, which reads metadata only, a few kB per dataset, in a second or two for the largest
/// files. Texts are read completely.
ChildLimits limits_of_a_walk(std::uint64_t size) {
  return {.seconds = 3 + static_cast<int>(size / 10'000'000), .memory = 3 * size + 200'000'000};
}

/// Identity of a file and of its last change: device, inode, size, time.
using Identity = std::array<std::int64_t, 5>;

Identity identity_of(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return {};
  return {static_cast<std::int64_t>(found.st_dev), static_cast<std::int64_t>(found.st_ino),
          static_cast<std::int64_t>(found.st_size), found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
}

/// Findings of the check. HDF5 calls back from C, so that no exception may be thrown.
struct Walk {
  std::string damaged;  ///< fault of an object
};

std::string name_of(hid_t object) {
  char name[256] = {};
  H5Iget_name(object, name, sizeof name);
  return name;
}

std::string unreadable_text(hid_t object) { return fmt::format("a text at {} cannot be read", name_of(object)); }

/// Reads texts. Their lengths are stored elsewhere in the file. If they are damaged, HDF5 clears gigabytes before it
/// fails.
/// @returns whether they could be read
bool read_texts(hid_t type, hid_t space, std::size_t count, const auto& read) {
  if (H5Tis_variable_str(type) <= 0) {
    std::vector<char> texts(count * H5Tget_size(type));
    return read(type, texts.data()) >= 0;
  }
  std::vector<char*> texts(count, nullptr);
  if (read(type, texts.data()) < 0) return false;
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, texts.data());
  return true;
}

herr_t walk_attribute(hid_t object, const char* name, const H5A_info_t*, void* data) {
  const Hdf5Id attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) return 0;
  const Hdf5Id type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count != 1) return 0;  // data of other shapes is not read
  const auto read = [&](hid_t memory, void* into) { return H5Aread(attribute, memory, into); };
  if (H5Tget_class(type) == H5T_STRING && !read_texts(type, space, 1, read)) {
    static_cast<Walk*>(data)->damaged = unreadable_text(object);
    return -1;
  }
  std::int64_t number = 0;
  if (H5Tget_class(type) == H5T_INTEGER) H5Aread(attribute, H5T_NATIVE_INT64, &number);
  return 0;
}

/// Chunks are read as they are stored: HDF5 reads beyond the end of a chunk that is too short. Compressed chunks may
/// have any size.
bool has_whole_chunks(hid_t dataset, hid_t type, hid_t space, hid_t creation) {
  if (H5Pget_layout(creation) != H5D_CHUNKED) return true;
  hsize_t chunks = 0;
  // A dataset that was being created when the program was killed may have no index yet; reading it fails in the
  // ordinary way.
  if (H5Dget_num_chunks(dataset, space, &chunks) < 0 || H5Pget_nfilters(creation) > 0) return true;
  std::array<hsize_t, H5S_MAX_RANK> shape{};
  const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, shape.data());
  hsize_t bytes = H5Tget_size(type);
  for (int k = 0; k < rank; ++k) bytes *= shape[static_cast<std::size_t>(k)];
  return H5Dget_storage_size(dataset) == chunks * bytes;
}

/// @returns a description of the fault; empty if there is none
std::string walk_dataset(hid_t dataset) {
  const Hdf5Id type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const Hdf5Id creation(H5Dget_create_plist(dataset), H5Pclose);
  if (!has_whole_chunks(dataset, type, space, creation))
    return fmt::format("the pieces of {} are not as large as they should be", name_of(dataset));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count <= 0) return {};
  if (H5Tget_class(type) == H5T_STRING) {
    if (static_cast<hsize_t>(count) > H5Dget_storage_size(dataset)) return {};  // refused by the reader
    const bool could_be_read = read_texts(type, space, static_cast<std::size_t>(count), [&](hid_t memory, void* data) {
      return H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    });
    return could_be_read ? std::string() : unreadable_text(dataset);
  }
  if (H5Tget_class(type) != H5T_FLOAT && H5Tget_class(type) != H5T_INTEGER) return {};
  const std::array<hsize_t, H5S_MAX_RANK> first{};
  const bool scalar = H5Sget_simple_extent_ndims(space) == 0;
  if (!scalar) H5Sselect_elements(space, H5S_SELECT_SET, 1, first.data());
  const Hdf5Id one = hdf5_space({});
  double real = 0;
  std::int64_t whole = 0;
  H5Dread(dataset, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &real);
  if (H5Tget_class(type) == H5T_INTEGER) H5Dread(dataset, H5T_NATIVE_INT64, one, space, H5P_DEFAULT, &whole);
  return {};
}

herr_t pass_over(hid_t, const char*, const H5L_info_t*, void*) { return 0; }

/// Returns whether the names in a group can be listed as Hdf5File::names_in does. If HDF5 fails half-way, it frees what
/// it has not set: it may crash in one program, and fail in another.
bool can_be_listed(hid_t group) {
  const Hdf5Id creation(H5Gget_create_plist(group), H5Pclose);
  unsigned order = 0;
  if (!creation.valid() || H5Pget_link_creation_order(creation, &order) < 0) return false;
  const H5_index_t index = (order & H5P_CRT_ORDER_TRACKED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
  return H5Literate(group, index, H5_ITER_INC, nullptr, pass_over, nullptr) >= 0;
}

herr_t walk_object(hid_t root, const char* name, const H5O_info_t*, void* data) {
  const Hdf5Id object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
  if (!object.valid()) return 0;
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, walk_attribute, data);
  auto& walk = *static_cast<Walk*>(data);
  if (walk.damaged.empty() && H5Iget_type(object) == H5I_DATASET) walk.damaged = walk_dataset(object);
  if (walk.damaged.empty() && H5Iget_type(object) == H5I_GROUP && !can_be_listed(object))
    walk.damaged = fmt::format("the names in {} cannot be listed", name_of(object));
  return walk.damaged.empty() ? 0 : -1;
}

/// Fills memory with values that cause a crash if they are used. HDF5 may read beyond the end of a damaged object, up
/// to 2 MB for a text, and whether it crashes depends on the memory found there. The crash must occur in this process,
/// and not later in the program; therefore both new and freed memory are filled.
void fill_free_memory() {
  constexpr int never_an_address = 0x5a, behind = 8 << 20;
  mallopt(M_PERTURB, never_an_address);
  mallopt(M_TRIM_THRESHOLD, 2 * behind);
  mallopt(M_MMAP_THRESHOLD, 2 * behind);
  void* volatile filled = std::malloc(behind);  // volatile, since compilers remove an allocation that is never read
  std::free(filled);
  H5set_free_list_limits(0, 0, 0, 0, 0, 0);  // HDF5 returns all memory at once
}

void walk(const std::string& path) {
  const Hdf5Id access = access_properties();
  const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  Walk found;
  if (file.valid()) H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, walk_object, &found, H5O_INFO_BASIC);
  if (!found.damaged.empty()) throw InputError(fmt::format("{}: is damaged: {}", path, found.damaged));
}

/// Findings about a file that was checked.
struct Finding {
  std::string fault;        ///< empty if there is none
  bool as_written = false;  ///< whether the file ends with the sum of its bytes
};

Finding check(const std::string& path, std::int64_t size) {
  if (has_own_byte_sum(path)) return {"", true};
  try {
    in_child_process(fmt::format("{}: is damaged: the HDF5 library crashes on it", path),
                     limits_of_a_walk(static_cast<std::uint64_t>(size)), [&] {
                       fill_free_memory();
                       walk(path);
                       return std::string();
                     });
  } catch (const InputError& error) {
    return {error.what(), false};
  }
  return {};
}

/// Returns the findings about a file. It is checked only once until it is written again.
Finding finding_about(const std::string& path) {
  static std::mutex guard;
  static std::map<Identity, Finding> findings;
  const Identity identity = identity_of(path);
  {
    const std::lock_guard lock(guard);
    if (const auto found = findings.find(identity); found != findings.end()) return found->second;
  }
  Finding finding = check(path, identity[2]);
  const std::lock_guard lock(guard);
  return findings[identity] = std::move(finding);
}

}  // namespace

void check_sound(const std::string& path) {
  if (const Finding finding = finding_about(path); !finding.fault.empty()) throw InputError(finding.fault);
}

bool is_as_written(const std::string& path) { return finding_about(path).as_written; }

std::string root_text_attribute(const std::string& path, const std::string& name) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return {};
  silence_hdf5();
  try {
    return in_child_process("damaged", limits_of_a_walk(0), [&]() -> std::string {
      const Hdf5Id access = access_properties();
      const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
      if (!file.valid() || H5Aexists(file, name.c_str()) <= 0) return {};
      const Hdf5Id attribute(H5Aopen(file, name.c_str(), H5P_DEFAULT), H5Aclose);
      const Hdf5Id type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
      if (H5Tis_variable_str(type) <= 0 || H5Sget_simple_extent_npoints(space) != 1) return {};
      char* text = nullptr;
      return H5Aread(attribute, type, &text) < 0 || text == nullptr ? std::string() : std::string(text);
    });
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace bielle
