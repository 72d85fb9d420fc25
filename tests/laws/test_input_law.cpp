// Law 5: a value outside its range, of the wrong kind, or missing is refused with file, line and key; so is an unknown
// key, however deep it stands. The tables of keys tell which values they do not allow.
#include <algorithm>
#include <cctype>
#include <sstream>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_keys.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_node.hpp"
#include "tests/laws/subject.hpp"
#include "tests/laws/wrong_values.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::laws;
using Catch::Contains;

namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '.');) parts.push_back(part);
  return parts;
}

bool is_index(const std::string& part) {
  return std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// "solid.1.cone" -> "solid.cone"
std::string without_indices(const std::string& path) {
  std::string key;
  for (const std::string& part : split(path))
    if (!is_index(part)) key += (key.empty() ? "" : ".") + part;
  return key;
}

/// Returns the path of the map that holds `it`: "joints", "hydraulics.lines".
std::string place_of(const Sample& sample) {
  return sample.place.empty() ? bielle::mechanism::section_name(sample.section) : sample.place;
}

/// A value of a model that may be changed.
struct Value {
  std::string scalar;  ///< as it is written in YAML
  std::vector<std::pair<std::string, Value>> pairs;
  std::vector<Value> items;

  explicit Value(const bielle::YamlNode& node) {
    scalar = node.kind == bielle::YamlNode::Kind::scalar ? quoted(node.scalar)
             : node.kind == bielle::YamlNode::Kind::map  ? "{}"
             : node.kind == bielle::YamlNode::Kind::null ? "~"
                                                         : "[]";
    for (const auto& [key, value] : node.pairs) pairs.emplace_back(key->scalar, Value(*value));
    for (const auto& item : node.items) items.emplace_back(*item);
  }
  explicit Value(const std::string& text) : Value(*bielle::parse_yaml(text, "model.yaml")) {}

  static std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char letter : text) result += letter == '\'' ? "''" : std::string(1, letter);
    return result + "'";
  }
  auto find(const std::string& key) {
    return std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == key; });
  }
  Value& at(const std::string& part) {
    if (!items.empty()) return items.at(std::stoul(part));
    const auto found = find(part);
    if (found == pairs.end()) throw std::logic_error("the sample has no '" + part + "'");
    return found->second;
  }
  void set(const std::string& key, const Value& value) {
    if (is_index(key) && !items.empty()) {
      const std::size_t k = std::stoul(key);
      k < items.size() ? void(items[k] = value) : items.push_back(value);
    } else if (const auto found = find(key); found != pairs.end()) {
      found->second = value;
    } else {
      pairs.emplace_back(key, value);
    }
  }
  void write(std::string& out) const {
    if (items.empty() && pairs.empty()) {
      out += scalar;
      return;
    }
    out += items.empty() ? "{" : "[";
    for (const auto& [key, value] : pairs) {
      out += "\n " + quoted(key) + ": ";
      value.write(out);
      out += ",";
    }
    for (const Value& item : items) {
      item.write(out);
      out += ",";
    }
    out += items.empty() ? "}" : "]";
  }
};

/// Returns the entry `it` of a model.
Value& entry_in(Value& root, const Sample& sample) {
  Value* value = &root;
  for (const std::string& part : split(place_of(sample))) value = &value->at(part);
  return value->at("it");
}

/// Returns the sample's model with one value of `it` changed; an empty value leaves the key out.
std::string changed(const Sample& sample, const std::string& key, const std::string& value) {
  Value root(sample.model);
  Value* entry = &entry_in(root, sample);
  std::vector<std::string> parts = split(key);
  const std::string last = parts.back();
  parts.pop_back();
  for (const std::string& part : parts) entry = &entry->at(part);
  if (value.empty()) {
    if (const auto found = entry->find(last); found != entry->pairs.end()) entry->pairs.erase(found);
  } else {
    entry->set(last, Value(value));
  }
  std::string out;
  root.write(out);
  return out;
}

std::string message(const Sample& sample, const std::string& text) {
  return bielle::test::message_of<bielle::InputError>([&] { read_sample(sample, text); });
}

/// Collects the paths of all maps below a value ("" the component itself).
void collect_maps(const Value& value, const std::string& path, std::vector<std::string>& maps) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (!value.pairs.empty() || value.scalar == "{}") maps.push_back(path);
  for (const auto& [key, below] : value.pairs) collect_maps(below, prefix + key, maps);
  for (std::size_t k = 0; k < value.items.size(); ++k) collect_maps(value.items[k], prefix + std::to_string(k), maps);
}

std::vector<std::string> maps_of(const Sample& sample) {
  Value root(sample.model);
  std::vector<std::string> maps;
  collect_maps(entry_in(root, sample), "", maps);
  return maps;
}

/// Returns the forms of `it`, from the tables of keys of a mechanism file.
bielle::KeyForms forms_of(const Sample& sample) {
  const bielle::KeyTable* table = &bielle::mechanism::mechanism_file_keys();
  const bielle::KeyForms* forms = nullptr;
  for (const std::string& part : split(place_of(sample))) {
    forms = &table->find(part)->forms;
    if (const bielle::KeyForm* nested = form_of(*forms, bielle::KeyForm::Kind::table)) table = &nested->table();
  }
  return form_of(*forms, bielle::KeyForm::Kind::entries)->items.front();
}

/// Returns the node of `it` in a tree.
std::shared_ptr<const bielle::YamlNode> entry_in(const bielle::YamlNode& root, const Sample& sample) {
  const bielle::YamlNode* map = &root;
  std::shared_ptr<const bielle::YamlNode> found;
  for (const std::string& part : split(place_of(sample) + ".it")) {
    for (const auto& [key, value] : map->pairs)
      if (key->scalar == part) found = value;
    map = found.get();
  }
  return found;
}

void check_refused(const Sample& sample, const std::string& key, const std::string& value, const std::string& says) {
  CAPTURE(title(sample), key, value);
  const std::string said = message(sample, changed(sample, key, value));
  CHECK_THAT(said, Contains("model.yaml:") && Contains(place_of(sample) + ".it"));
  CHECK_THAT(said, Contains(split(without_indices(key)).back()));
  CHECK_THAT(said, Contains(says));
}

}  // namespace

TEST_CASE("law 5: values that the tables of keys do not allow are refused with their key") {
  for (const Sample& sample : samples()) {
    const auto root = bielle::parse_yaml(sample.model, "model.yaml");
    const auto entry = entry_in(*root, sample);
    CAPTURE(title(sample));
    CHECK(is_allowed(forms_of(sample), *entry));
    for (const ShownKey& shown : shown_keys(forms_of(sample), *entry)) {
      for (const WrongValue& wrong : wrong_values(*shown.key, *shown.value))
        check_refused(sample, shown.path, wrong.text, wrong.says);
      if (shown.path != "type") check_refused(sample, shown.path, "{nonsense: 1}", "");
    }
  }
}

TEST_CASE("law 5: values that only the model makes wrong are refused with their key") {
  for (const Sample& sample : samples()) {
    const auto root = bielle::parse_yaml(sample.model, "model.yaml");
    for (const BadValue& bad : sample.bad) {
      check_refused(sample, bad.key, bad.value, bad.says);
      // Those that a table forbids are made from it.
      const auto wrong = bielle::parse_yaml(changed(sample, bad.key, bad.value), "model.yaml");
      CAPTURE(title(sample), bad.key, bad.value);
      CHECK(is_allowed(forms_of(sample), *entry_in(*wrong, sample)));
    }
  }
}

TEST_CASE("law 5: unknown keys are refused, however deep they stand") {
  for (const Sample& sample : samples())
    for (const std::string& map : maps_of(sample))
      check_refused(sample, (map.empty() ? "" : map + ".") + "nonsense", "1", "");
}
