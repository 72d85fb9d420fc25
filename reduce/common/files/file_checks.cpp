#include "reduce/common/files/file_checks.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "reduce/common/error.hpp"

namespace bielle {

namespace {

/// The longest file name, less room for the suffix that it has until the file is complete.
constexpr std::size_t longest_name = 255 - 16;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw InputError(fmt::format("{}: {}", path, what));
}

}  // namespace

void check_input_file(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) fail(path, "there is no such file");
    fail(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  }
  if (S_ISDIR(found.st_mode)) fail(path, "is a folder, expected a file");
  const bool handed_over = S_ISFIFO(found.st_mode) && (path.starts_with("/dev/") || path.starts_with("/proc/"));
  if (!S_ISREG(found.st_mode) && !handed_over) fail(path, "is a device or a pipe, expected a file");
}

std::string read_input_text(const std::string& path) {
  check_input_file(path);
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) fail(path, "cannot be read");
  return text;
}

void check_output_file(const std::string& path) {
  const std::filesystem::path name(path);
  if (name.filename().string().size() > longest_name)
    fail(path, fmt::format("the file name is too long: at most {} letters", longest_name));
  const std::string folder = name.parent_path().empty() ? "." : name.parent_path().string();
  struct stat found {};
  if (stat(folder.c_str(), &found) != 0 || !S_ISDIR(found.st_mode))
    fail(path, fmt::format("there is no folder '{}'", folder));
  if (access(folder.c_str(), W_OK) != 0)
    fail(path, fmt::format("no file can be written there: {}", std::strerror(errno)));
  if (stat(path.c_str(), &found) != 0) {
    if (errno == ENOENT) return;
    fail(path, fmt::format("cannot be written: {}", std::strerror(errno)));
  }
  if (!S_ISREG(found.st_mode)) fail(path, "is a folder or a device; expected a file name");
  if (access(path.c_str(), W_OK) != 0) fail(path, fmt::format("cannot be written: {}", std::strerror(errno)));
}

}  // namespace bielle
