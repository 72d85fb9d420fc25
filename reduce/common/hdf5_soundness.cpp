#include "reduce/common/hdf5_soundness.hpp"

#include <array>
#include <cstdint>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <sys/stat.h>

#include "reduce/common/child_process.hpp"
#include "reduce/common/hdf5_handle.hpp"

namespace bielle {

namespace {

/// Of processor time: walking through the largest files takes a second or two.
constexpr int longest_walk = 5;

/// What a file is and when it was written last: device, inode, size, time.
using Identity = std::array<std::int64_t, 5>;

Identity identity_of(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return {};
  return {static_cast<std::int64_t>(found.st_dev), static_cast<std::int64_t>(found.st_ino),
          static_cast<std::int64_t>(found.st_size), found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
}

void read_texts(hid_t type, hid_t space, std::size_t count, const auto& read) {
  if (H5Tis_variable_str(type) <= 0) {
    std::vector<char> texts(count * H5Tget_size(type));
    read(type, texts.data());
    return;
  }
  std::vector<char*> texts(count, nullptr);
  if (read(type, texts.data()) < 0) return;
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, texts.data());
}

herr_t walk_attribute(hid_t object, const char* name, const H5A_info_t*, void*) {
  const Hdf5Id attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) return 0;
  const Hdf5Id type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count != 1) return 0;  // of other shapes none is read
  if (H5Tget_class(type) == H5T_STRING)
    read_texts(type, space, 1, [&](hid_t memory, void* data) { return H5Aread(attribute, memory, data); });
  std::int64_t number = 0;
  if (H5Tget_class(type) == H5T_INTEGER) H5Aread(attribute, H5T_NATIVE_INT64, &number);
  return 0;
}

void walk_dataset(hid_t dataset) {
  const Hdf5Id type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const Hdf5Id creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(creation) == H5D_CHUNKED) {
    hsize_t chunks = 0;
    H5Dget_num_chunks(dataset, H5S_ALL, &chunks);
  }
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count <= 0) return;
  if (H5Tget_class(type) == H5T_STRING) {
    if (static_cast<hsize_t>(count) > H5Dget_storage_size(dataset)) return;  // refused by those who read it
    read_texts(type, space, static_cast<std::size_t>(count), [&](hid_t memory, void* data) {
      return H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    });
    return;
  }
  if (H5Tget_class(type) != H5T_FLOAT && H5Tget_class(type) != H5T_INTEGER) return;
  const std::array<hsize_t, H5S_MAX_RANK> first{};
  const bool scalar = H5Sget_simple_extent_ndims(space) == 0;
  if (!scalar) H5Sselect_elements(space, H5S_SELECT_SET, 1, first.data());
  const Hdf5Id one = hdf5_space({});
  double real = 0;
  std::int64_t whole = 0;
  H5Dread(dataset, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &real);
  if (H5Tget_class(type) == H5T_INTEGER) H5Dread(dataset, H5T_NATIVE_INT64, one, space, H5P_DEFAULT, &whole);
}

herr_t pass_over(hid_t, const char*, const H5L_info_t*, void*) { return 0; }

herr_t walk_object(hid_t root, const char* name, const H5O_info_t*, void*) {
  const Hdf5Id object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
  if (!object.valid()) return 0;
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, walk_attribute, nullptr);
  if (H5Iget_type(object) == H5I_DATASET) walk_dataset(object);
  if (H5Iget_type(object) == H5I_GROUP)
    H5Literate(object, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, pass_over, nullptr);
  return 0;
}

void walk(const std::string& path) {
  const Hdf5Id access = access_properties();
  const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (file.valid()) H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, walk_object, nullptr, H5O_INFO_BASIC);
}

}  // namespace

void check_sound(const std::string& path) {
  static std::mutex guard;
  static std::set<Identity> sound;
  const Identity identity = identity_of(path);
  {
    const std::lock_guard lock(guard);
    if (sound.contains(identity)) return;
  }
  in_child_process(fmt::format("{}: is damaged: the HDF5 library crashes on it", path), longest_walk, [&] {
    walk(path);
    return std::string();
  });
  const std::lock_guard lock(guard);
  sound.insert(identity);
}

}  // namespace bielle
