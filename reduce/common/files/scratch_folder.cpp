#include "reduce/common/files/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle {

ScratchFolder::ScratchFolder() {
  std::error_code failed;
  const auto base = std::filesystem::temp_directory_path(failed);
  std::string name = ((failed ? std::filesystem::path("/tmp") : base) / "bielle-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw ComputationError(fmt::format("no temporary folder '{}' can be made: {}", name, std::strerror(errno)));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace bielle
