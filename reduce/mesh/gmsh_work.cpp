#include "reduce/mesh/gmsh_work.hpp"

#include <array>
#include <filesystem>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

namespace fs = std::filesystem;

// Returns nullptr if the module is at none of the places. @param failure  gets the reason of the last one
void* open_module(std::string& failure) {
  constexpr const char* name = "bielle-gmsh.so";
  std::error_code ignored;
  const fs::path prefix = fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
  const std::array<fs::path, 2> folders = {prefix / BIELLE_MODULES_INSTALLED, BIELLE_MODULES_BUILT};
  std::string place = name;
  for (const fs::path& folder : folders) {
    if (!fs::exists(folder / name, ignored)) continue;
    place = (folder / name).string();
    break;
  }
  void* module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) failure = dlerror();
  return module;
}

const GmshWork& load() {
  std::string failure;
  void* module = open_module(failure);
  const void* work = module == nullptr ? nullptr : dlsym(module, "bielle_gmsh_work");
  if (work == nullptr)
    throw ComputationError(
        fmt::format("the module that reads and meshes bodies by gmsh cannot be loaded: {}; install "
                    "Bielle again, or name the folder of bielle-gmsh.so in LD_LIBRARY_PATH",
                    failure.empty() ? "it is of another version" : failure));
  return *static_cast<const GmshWork*>(work);
}

}  // namespace

const GmshWork& gmsh_work() {
  static const GmshWork& work = load();
  return work;
}

}  // namespace bielle::reduce
