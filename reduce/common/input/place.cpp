#include "reduce/common/input/place.hpp"

#include <fmt/format.h>

namespace bielle {

std::string path_of_key(const std::string& path_of_map, const std::string& key) {
  return path_of_map.empty() ? key : path_of_map + "." + key;
}

std::string located_at(const std::string& file, int line, const std::string& path, const std::string& message) {
  return fmt::format("{}:{}: {}{}{}", file, line, path, path.empty() ? "" : ": ", message);
}

}  // namespace bielle
