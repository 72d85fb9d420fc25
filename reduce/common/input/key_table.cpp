#include "reduce/common/input/key_table.hpp"

#include <algorithm>
#include <utility>

#include "reduce/common/input/yaml_node.hpp"

namespace bielle {

Key::Key(std::string name_, KeyForms forms_, Presence presence_, std::string about_)
    : name(std::move(name_)), forms(std::move(forms_)), presence(std::move(presence_)), about(std::move(about_)) {
  if (!presence.value.empty()) preset = parse_yaml(presence.value, "default of " + name);
}

Key::Key(std::string name_, KeyForm form, Presence presence_, std::string about_)
    : Key(std::move(name_), KeyForms{std::move(form)}, std::move(presence_), std::move(about_)) {}

const Key* KeyTable::find(const std::string& name) const {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

std::vector<std::string> KeyTable::names() const { return keys::names_of(keys); }

const KeyTable& KeyTable::of_map(const YamlNode& map) const {
  for (const Variant& variant : variants)
    for (const auto& [key, value] : map.pairs)
      if (key->scalar == variant.key && (variant.value.empty() || value->scalar == variant.value))
        return variant.table();
  return *this;
}

namespace keys {

Presence otherwise(std::string value) { return {false, std::move(value), {}}; }
Presence computed(std::string words) { return {false, {}, std::move(words)}; }

std::vector<std::string> names_of(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(key.name);
  return names;
}

std::vector<Key> joined(std::vector<std::vector<Key>> groups) {
  std::vector<Key> all;
  for (std::vector<Key>& group : groups)
    for (Key& key : group) all.push_back(std::move(key));
  return all;
}

}  // namespace keys
}  // namespace bielle
