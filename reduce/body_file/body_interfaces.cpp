#include "reduce/body_file/body_interfaces.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

void check_name(const std::string& name, const YamlValue& value) {
  if (name.empty() || name.find('/') != std::string::npos) value.fail("expected a name without '/'");
}

Tie read_tie(const YamlValue& value) {
  const std::string word = value.word({"rigid", "average", "free"}, "a tie");
  return word == "rigid" ? Tie::rigid : word == "average" ? Tie::average : Tie::free;
}

std::array<bool, 6> read_directions(const YamlValue& value, Tie tie) {
  static const std::vector<std::string> names = {"x", "y", "z", "rx", "ry", "rz"};
  std::array<bool, 6> kept{};
  for (const YamlValue& item : value.items()) {
    const auto found = std::find(names.begin(), names.end(), item.word(names, "a direction"));
    const std::size_t k = found - names.begin();
    if (kept[k]) item.fail(fmt::format("'{}' stands here twice", *found));
    if (k >= 3 && tie == Tie::free) item.fail("the nodes of a free interface have no rotations; expected x, y or z");
    kept[k] = true;
  }
  if (value.size() == 0) value.fail("expected at least one direction out of x, y, z, rx, ry, rz");
  return kept;
}

}  // namespace bielle::reduce
