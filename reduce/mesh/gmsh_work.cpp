#include "reduce/mesh/gmsh_work.hpp"

#include <cerrno>
#include <filesystem>
#include <new>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

namespace fs = std::filesystem;

// Returns nullptr if the module is at none of the places. @param failure  gets the reason of the first one that exists
void* open_module(std::string& failure) {
  constexpr const char* name = "bielle-gmsh.so";
  std::error_code unknown, ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  std::vector<fs::path> folders = {BIELLE_MODULES_BUILT, BIELLE_MODULES_INSTALLED, BIELLE_MODULES_PACKAGED};
  if (!unknown) folders.insert(folders.begin(), program.parent_path().parent_path() / BIELLE_MODULES_OF_PREFIX);
  std::vector<std::string> places;
  for (const fs::path& folder : folders)
    if (fs::exists(folder / name, ignored)) places.push_back((folder / name).string());
  places.emplace_back(name);
  for (const std::string& place : places) {
    errno = 0;
    if (void* module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
    if (errno == ENOMEM) throw std::bad_alloc();
    if (failure.empty()) failure = dlerror();
  }
  return nullptr;
}

const GmshWork& load() {
  std::string failure;
  void* module = open_module(failure);
  const auto* work = module == nullptr ? nullptr : static_cast<const GmshWork*>(dlsym(module, "bielle_gmsh_work"));
  if (work != nullptr && work->build == GmshWork::Build()) return *work;
  throw ComputationError(
      fmt::format("the module that reads and meshes bodies by gmsh cannot be loaded: {}; install "
                  "Bielle again, or name the folder of bielle-gmsh.so in LD_LIBRARY_PATH",
                  module != nullptr ? "it is of another version" : failure));
}

}  // namespace

const GmshWork& gmsh_work() {
  static const GmshWork& work = load();
  return work;
}

}  // namespace bielle::reduce
