#include "reduce/mesh/signature.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

struct Signature {
  const char* format;
  std::vector<std::string> endings;
  const char* begin;  ///< one of the first words
  const char* end;    ///< one of the last; empty: none
};

const std::vector<Signature>& signatures() {
  static const std::vector<Signature> all = {
      {"STEP", {".step", ".stp"}, "ISO-10303-21;", "END-ISO-10303-21;"},
      {"BREP", {".brep"}, "CASCADE Topology", ""},
      {"MSH", {".msh"}, "$", ""},
  };
  return all;
}

/// Reads at most a given number of bytes from the position on.
std::string part_of(const std::string& path, std::uintmax_t begin) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(begin));
  std::string text(4096, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace

void check_signature(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const Signature& format : signatures()) {
    if (std::find(format.endings.begin(), format.endings.end(), ending) == format.endings.end()) continue;
    if (part_of(path, 0).find(format.begin) == std::string::npos)
      throw InputError(fmt::format("'{}' cannot be read: it is no {} file: one begins with '{}'", path, format.format,
                                   format.begin));
    const std::uintmax_t size = std::filesystem::file_size(path);
    if (part_of(path, size > 4096 ? size - 4096 : 0).find(format.end) == std::string::npos)
      throw InputError(
          fmt::format("'{}' cannot be read: it is cut off: a {} file ends with '{}'", path, format.format, format.end));
  }
}

}  // namespace bielle::reduce
