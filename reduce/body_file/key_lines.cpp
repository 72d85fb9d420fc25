#include "reduce/body_file/key_lines.hpp"

#include <fmt/format.h>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

KeyLines::KeyLines(const YamlValue& root) : file_(root.file()) {
  for (const auto& [key, value] : root.entries()) add(value);
}

void KeyLines::add(const YamlValue& value) {
  lines_.emplace(value.path(), value.line());
  if (value.is_map())
    for (const auto& [key, inner] : value.entries()) add(inner);
  if (value.is_sequence())
    for (const YamlValue& item : value.items()) add(item);
}

std::string KeyLines::located(const std::string& subject, const std::string& message) const {
  for (std::string path = subject; !path.empty();) {
    if (const auto found = lines_.find(path); found != lines_.end())
      return fmt::format("{}:{}: {}", file_, found->second, message);
    const std::size_t end = path.find_last_of(".[");
    path.resize(end == std::string::npos ? 0 : end);
  }
  return message;
}

}  // namespace bielle::reduce
