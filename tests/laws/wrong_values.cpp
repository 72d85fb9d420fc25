#include "tests/laws/wrong_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/input/unit.hpp"

namespace bielle::laws {
namespace {

using Kind = KeyForm::Kind;

bool is_number_of(const KeyForm& form, const std::string& text) {
  if (text == ".nan") return false;
  if (const auto value = plain_number(text))
    return form.in_range(*value) && (form.kind != Kind::integer || *value == std::floor(*value));
  if (const auto quantity = quantity_of(text)) {
    try {
      return form.in_range(to_si(*quantity, form.unit));
    } catch (const std::runtime_error&) {
      return false;
    }
  }
  return true;  // a formula
}

bool is_list_of(const KeyForm& form, const YamlNode& value) {
  if (value.kind != YamlNode::Kind::sequence || value.items.size() < form.fewest ||
      value.items.size() > form.most_items)
    return false;
  for (std::size_t k = 0; k < value.items.size() && !form.items.empty(); ++k)
    if (!is_allowed(form.items[std::min(k, form.items.size() - 1)], *value.items[k])) return false;
  return true;
}

bool is_map_of(const KeyTable& general, const YamlNode& map) {
  const KeyTable& table = general.of_map(map);
  const auto has = [&](const std::string& name) {
    return std::any_of(map.pairs.begin(), map.pairs.end(),
                       [&](const YamlNode::Pair& pair) { return pair.key->scalar == name; });
  };
  for (const YamlNode::Pair& pair : map.pairs) {
    const Key* key = table.find(pair.key->scalar);
    if (!key || !is_allowed(key->forms, *pair.value)) return false;
  }
  return std::all_of(table.keys.begin(), table.keys.end(),
                     [&](const Key& key) { return !key.presence.required || has(key.name); });
}

bool is_of_form(const KeyForm& form, const YamlNode& value) {
  const bool scalar = value.kind == YamlNode::Kind::scalar, map = value.kind == YamlNode::Kind::map;
  switch (form.kind) {
    case Kind::number:
    case Kind::integer:
    case Kind::formula:
      return scalar && is_number_of(form, value.scalar);
    case Kind::boolean:
      return scalar && (value.scalar == "true" || value.scalar == "false");
    case Kind::word:
      return scalar && std::find(form.words.begin(), form.words.end(), value.scalar) != form.words.end();
    case Kind::text:
    case Kind::file:
    case Kind::name:
      return scalar;
    case Kind::list:
      return is_list_of(form, value);
    case Kind::table:
      return map && is_map_of(form.table(), value);
    case Kind::entries:
      return map && std::all_of(value.pairs.begin(), value.pairs.end(), [&](const YamlNode::Pair& pair) {
               return is_allowed(form.items.front(), *pair.value);
             });
    case Kind::null:
      return value.kind == YamlNode::Kind::null;
  }
  return false;
}

void collect(const KeyForms& forms, const YamlNode& value, const std::string& path, std::vector<ShownKey>& keys) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (value.kind == YamlNode::Kind::sequence) {
    const KeyForm* form = form_of_list(forms, value);
    for (std::size_t k = 0; form && k < value.items.size(); ++k)
      collect(form->items[std::min(k, form->items.size() - 1)], *value.items[k], prefix + std::to_string(k), keys);
  }
  if (value.kind != YamlNode::Kind::map) return;
  const auto fits = [&](const KeyForm& form) { return form.kind == Kind::table && is_map_of(form.table(), value); };
  const auto table = std::find_if(forms.begin(), forms.end(), fits);
  const KeyForm* entries = form_of(forms, Kind::entries);
  for (const YamlNode::Pair& pair : value.pairs) {
    const std::string below = prefix + pair.key->scalar;
    if (table != forms.end()) {
      const Key& key = *table->table().of_map(value).find(pair.key->scalar);
      keys.push_back({below, &key, pair.value.get()});
      collect(key.forms, *pair.value, below, keys);
    } else if (entries) {
      collect(entries->items.front(), *pair.value, below, keys);
    }
  }
}

/// Adds values that one form does not allow.
void add_wrong_values(const KeyForm& form, const YamlNode& shown, std::vector<WrongValue>& values) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (form.is_numeric()) {
    const std::string range = form.range_words();
    if (form.least > -infinity) values.push_back({fmt::format("{}", form.above ? form.least : form.least - 1), range});
    if (form.most < infinity) values.push_back({fmt::format("{}", form.below ? form.most : form.most + 1), range});
    if (form.kind == Kind::integer)
      // A value within the range.
      values.push_back({fmt::format("{}", (form.least > -infinity ? form.least : 1) + 0.5), "whole"});
    values.push_back({"1 cd", "cd"});
    values.push_back({".nan", "nan"});
  }
  if (form.kind == Kind::word) values.push_back({"nonsense", "nonsense"});
  if (form.kind == Kind::boolean) values.push_back({"maybe", "maybe"});
  if (form.kind != Kind::list || shown.kind != YamlNode::Kind::sequence || shown.items.empty()) return;
  std::vector<std::string> items;
  for (const auto& item : shown.items) {
    if (item->kind != YamlNode::Kind::scalar) return;
    items.push_back("'" + item->scalar + "'");
  }
  std::vector<std::string> longer = items, shorter = items;
  longer.push_back(items.back());
  shorter.pop_back();
  values.push_back({fmt::format("[{}]", fmt::join(longer, ", ")), ""});
  values.push_back({fmt::format("[{}]", fmt::join(shorter, ", ")), ""});
  std::vector<WrongValue> of_item;
  for (const KeyForm& each : form.items.back()) add_wrong_values(each, *shown.items.back(), of_item);
  for (const WrongValue& wrong : of_item) {
    items.back() = wrong.text;
    values.push_back({fmt::format("[{}]", fmt::join(items, ", ")), wrong.says});
  }
}

}  // namespace

bool is_allowed(const KeyForms& forms, const YamlNode& value) {
  return std::any_of(forms.begin(), forms.end(), [&](const KeyForm& form) { return is_of_form(form, value); });
}

std::vector<ShownKey> shown_keys(const KeyForms& forms, const YamlNode& value) {
  std::vector<ShownKey> keys;
  collect(forms, value, "", keys);
  return keys;
}

std::vector<WrongValue> wrong_values(const Key& key, const YamlNode& shown) {
  std::vector<WrongValue> values;
  // Forms other than the one that the sample shows may be wrong here for another reason.
  for (const KeyForm& form : key.forms)
    if (is_of_form(form, shown)) add_wrong_values(form, shown, values);
  const auto allowed = [&](const WrongValue& wrong) { return is_allowed(key.forms, *parse_yaml(wrong.text, "value")); };
  values.erase(std::remove_if(values.begin(), values.end(), allowed), values.end());
  if (key.presence.required) values.emplace_back();
  return values;
}

}  // namespace bielle::laws
