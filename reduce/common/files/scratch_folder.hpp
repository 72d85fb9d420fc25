// A folder for temporary files.
#pragma once

#include <filesystem>

namespace bielle {

/// A folder for temporary files that disappears with the object.
class ScratchFolder {
 public:
  ScratchFolder();  ///< @throws ComputationError when none can be made
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace bielle
