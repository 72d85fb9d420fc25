#include "mechanism/language/each_entry.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/language/language_keys.hpp"
#include "reduce/common/input/unit.hpp"

namespace bielle::mechanism {
namespace {

using UseScope = std::function<void(const Scope&)>;

constexpr int most = 1'000'000;  ///< largest number of entries from one entry

/// Evaluates a number that has no unit.
double pure_number(const YamlNode& node, const Scope& scope, const std::string& path) {
  if (quantity_of(node.scalar))
    fail_at(node, *scope.main_file, path, fmt::format("expected a number without a unit, found '{}'", node.scalar));
  return scope.number(node, path);
}

int whole_number(const YamlNode& node, const Scope& scope, const std::string& path) {
  const double value = pure_number(node, scope, path);
  if (value != std::floor(value) || std::abs(value) > 1e9)
    fail_at(node, *scope.main_file, path, fmt::format("expected a whole number, found {}", value));
  return static_cast<int>(value);
}

/// Refuses a name of a number or word that has a meaning already.
void check_name_of_number(const std::string& name, const Scope& scope, const YamlNode& place, const std::string& path) {
  check_word(name, place, *scope.main_file, path);
  bool is_known = scope.parameters->count(name) > 0;
  for (const Scope* each = &scope; each && each->prefix == scope.prefix; each = each->outer)
    is_known = is_known || each->values.count(name) || each->words.count(name) || each->measures.count(name);
  if (is_known)
    fail_at(place, *scope.main_file, path,
            fmt::format("'{}' has a meaning in formulas already; choose another name", name));
}

/// The repetitions of one entry.
struct Repetition {
  std::vector<Tree> directions;
  std::string path;     ///< path of the entry, for messages
  const UseScope* use;  ///< nullptr: the entries are only counted
  int entries = 0;      ///< number of entries so far
};

/// Counts entries of the last direction. @returns whether counting is all that is required
bool only_counts(Repetition& repetition, std::size_t direction, std::size_t entries, const Scope& scope) {
  if (repetition.use || direction + 1 < repetition.directions.size()) return false;
  repetition.entries += static_cast<int>(entries);
  if (repetition.entries > most)
    fail_at(*repetition.directions.front(), *scope.main_file, repetition.path + ".repeat",
            fmt::format("these are more than {} entries", most));
  return true;
}

/// Calls `use` for every combination of the numbers and words of a direction and those behind it, or counts them.
void for_each_number(Repetition& repetition, std::size_t direction, const Scope& scope) {
  if (direction == repetition.directions.size()) return (*repetition.use)(scope);
  const Tree& tree = repetition.directions[direction];
  const YamlNode& repeat = *tree;
  const std::string place = repetition.path + ".repeat";
  const YamlValue keys = value_at(tree, place, *scope.main_file).keyed(repeat_keys());
  const std::string as = keys.at("as").text();
  check_name_of_number(as, scope, repeat, place + ".as");
  if (const Tree over = find_value(repeat, "over")) {
    if (find_pair(repeat, "count") || find_pair(repeat, "from"))
      fail_at(repeat, *scope.main_file, place, "`over` lists the words: `count` and `from` do not go with it");
    for (const YamlValue& item : keys.at("over").items()) item.text();  // throws if it is not a list of words
    if (only_counts(repetition, direction, over->items.size(), scope)) return;
    for (const Tree& item : over->items) {
      Scope local = scope.inner();
      local.words[as] = scope.text(*item, place + ".over");
      if (const auto number = plain_number(local.words[as])) local.values[as] = *number;
      for_each_number(repetition, direction + 1, local);
    }
    return;
  }
  if (!find_pair(repeat, "count"))
    fail_at(repeat, *scope.main_file, place, "give the `count` of entries, or the words `over` which they go");
  const int count = whole_number(*find_value(repeat, "count"), scope, place + ".count");
  if (count < 0 || count > most)
    fail_at(repeat, *scope.main_file, place + ".count", fmt::format("expected 0 to {} entries, found {}", most, count));
  const Tree from = find_value(repeat, "from");
  if (only_counts(repetition, direction, static_cast<std::size_t>(count), scope)) return;
  const int first = from ? whole_number(*from, scope, place + ".from") : 1;
  for (int k = first; k < first + count; ++k) {
    Scope local = scope.inner();
    local.values[as] = k;
    for_each_number(repetition, direction + 1, local);
  }
}

}  // namespace

bool holds(const YamlNode& condition, const Scope& scope, const std::string& path) {
  if (condition.scalar == "true") return true;
  if (condition.scalar == "false") return false;
  return pure_number(condition, scope, path) != 0;
}

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
      if (condition && !holds(*condition, local, place + ".if")) return;
      use(local.replaces() ? local.text(*pair.key, place) : pair.key->scalar, value, local);
    };
    if (!repeat) {
      use_one(scope);
      continue;
    }
    Repetition repetition{{repeat}, place, nullptr};
    if (repeat->kind == YamlNode::Kind::sequence) repetition.directions = repeat->items;
    if (repetition.directions.empty())
      fail_at(*repeat, *scope.main_file, place + ".repeat", "expected a repetition, or a list of one or more");
    // Counts first, because the conditions of a million entries would take half a minute.
    for_each_number(repetition, 0, scope);
    repetition.use = &use_one;
    for_each_number(repetition, 0, scope);
  }
}

}  // namespace bielle::mechanism
