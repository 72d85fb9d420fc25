#include "reduce/output_file.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/file_checks.hpp"

namespace bielle::reduce {

void check_output(const std::string& path, std::initializer_list<std::string> inputs) {
  check_output_file(path);
  for (const std::string& source : inputs) {
    std::error_code missing;
    if (std::filesystem::equivalent(path, source, missing))
      throw InputError(fmt::format("{}: the superelement would replace its own input", path));
  }
}

std::string written(const std::string& path) {
  return fmt::format("written: {} ({:.1f} MB)\n", path, 1e-6 * static_cast<double>(std::filesystem::file_size(path)));
}

}  // namespace bielle::reduce
