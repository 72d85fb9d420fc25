#include "mechanism/language/each_entry.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/language/language_keys.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {
namespace {

using UseScope = std::function<void(const Scope&)>;

int whole_number(const YamlNode& node, const Scope& scope, const std::string& path) {
  const double value = scope.number(node, path);
  if (value != std::floor(value) || std::abs(value) > 1e9)
    fail_at(node, *scope.main_file, path, fmt::format("expected a whole number, found {}", value));
  return static_cast<int>(value);
}

bool holds(const YamlNode& condition, const Scope& scope, const std::string& path) {
  if (condition.scalar == "true") return true;
  if (condition.scalar == "false") return false;
  return scope.number(condition, path + ".if") != 0;
}

/// Calls `use` for every combination of the numbers and words of `directions[direction]` and those behind it.
void for_each_number(const std::vector<Tree>& directions, std::size_t direction, const Scope& scope,
                     const std::string& path, const UseScope& use) {
  if (direction == directions.size()) return use(scope);
  const YamlNode& repeat = *directions[direction];
  const std::string place = path + ".repeat";
  const YamlValue keys =
      YamlValue::of_tree(directions[direction], "", repeat.file ? *repeat.file : *scope.main_file).keyed(repeat_keys());
  const std::string as = keys.at("as").text();
  if (as.empty() || as == "t" || scope.parameters->count(as))
    fail_at(repeat, *scope.main_file, place,
            fmt::format("'{}' has a meaning in formulas already; choose another name", as));
  if (const Tree over = find_value(repeat, "over")) {
    if (find_pair(repeat, "count") || find_pair(repeat, "from"))
      fail_at(repeat, *scope.main_file, place, "`over` lists the words: `count` and `from` do not go with it");
    for (const YamlValue& item : keys.at("over").items()) item.text();  // refuses what is no list of words
    for (const Tree& item : over->items) {
      Scope local = scope.inner();
      local.words[as] = scope.text(*item, place + ".over");
      if (const auto number = plain_number(local.words[as])) local.values[as] = *number;
      for_each_number(directions, direction + 1, local, path, use);
    }
    return;
  }
  if (!find_pair(repeat, "count"))
    fail_at(repeat, *scope.main_file, place, "give the `count` of entries, or the words `over` which they go");
  const int count = whole_number(*find_value(repeat, "count"), scope, place + ".count");
  constexpr int most = 1'000'000;
  if (count < 0 || count > most)
    fail_at(repeat, *scope.main_file, place + ".count", fmt::format("expected 0 to {} entries, found {}", most, count));
  const Tree from = find_value(repeat, "from");
  const int first = from ? whole_number(*from, scope, place + ".from") : 1;
  for (int k = first; k < first + count; ++k) {
    Scope local = scope.inner();
    local.values[as] = k;
    for_each_number(directions, direction + 1, local, path, use);
  }
}

}  // namespace

void for_each_entry(const YamlNode& section, const Scope& scope, const std::string& path, const UseEntry& use) {
  if (section.kind == YamlNode::Kind::null) return;
  if (section.kind != YamlNode::Kind::map)
    fail_at(section, *scope.main_file, path, "expected keys with values (`key: value`)");
  for (const YamlNode::Pair& pair : section.pairs) {
    const std::string place = path + "." + scope.prefix + pair.key->scalar;
    const bool is_map = pair.value->kind == YamlNode::Kind::map;
    const Tree repeat = is_map ? find_value(*pair.value, "repeat") : nullptr;
    const Tree condition = is_map ? find_value(*pair.value, "if") : nullptr;
    const Tree value = repeat || condition ? without(*pair.value, {"repeat", "if"}) : pair.value;
    const UseScope use_one = [&](const Scope& local) {
      if (condition && !holds(*condition, local, place)) return;
      use(local.replaces() ? local.text(*pair.key, place) : pair.key->scalar, value, local);
    };
    if (!repeat)
      use_one(scope);
    else
      for_each_number(repeat->kind == YamlNode::Kind::sequence ? repeat->items : std::vector<Tree>{repeat}, 0, scope,
                      place, use_one);
  }
}

}  // namespace bielle::mechanism
