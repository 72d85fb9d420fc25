// Law 5: a value outside its range, of the wrong kind, or missing is refused with file, line and key; so is an unknown
// key, however deep it stands. Every key stands in the manual.
#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_node.hpp"
#include "tests/laws/subject.hpp"
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

/// The path of the map that holds `it`: "joints", "hydraulics.lines".
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

/// The entry `it` of a model.
Value& entry_in(Value& root, const Sample& sample) {
  Value* value = &root;
  for (const std::string& part : split(place_of(sample))) value = &value->at(part);
  return value->at("it");
}

/// The sample's model with one value of `it` changed; an empty value leaves the key out.
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

/// Paths of all keys below a value, and of the maps that hold them ("" the component itself).
void collect(const Value& value, const std::string& path, std::vector<std::string>& keys,
             std::vector<std::string>& maps) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (!value.pairs.empty() || value.scalar == "{}") maps.push_back(path);
  for (const auto& [key, below] : value.pairs) {
    keys.push_back(prefix + key);
    collect(below, prefix + key, keys, maps);
  }
  for (std::size_t k = 0; k < value.items.size(); ++k) collect(value.items[k], prefix + std::to_string(k), keys, maps);
}

struct Keys {
  std::vector<std::string> paths, maps;
  explicit Keys(const Sample& sample) {
    Value root(sample.model);
    collect(entry_in(root, sample), "", paths, maps);
  }
};

/// Keys of a type, without indices, for which some sample of the type has an invalid value.
std::set<std::string> keys_with_bad_values(const Sample& like) {
  std::set<std::string> keys;
  for (const Sample& sample : samples())
    if (sample.section == like.section && sample.type == like.type)
      for (const BadValue& bad : sample.bad) keys.insert(without_indices(bad.key));
  return keys;
}

}  // namespace

TEST_CASE("law 5: values out of range are refused with their key") {
  for (const Sample& sample : samples()) {
    const std::string place = place_of(sample) + ".it";
    for (const BadValue& bad : sample.bad) {
      CAPTURE(title(sample), bad.key, bad.value);
      const std::string said = message(sample, changed(sample, bad.key, bad.value));
      CHECK_THAT(said, Contains("model.yaml:") && Contains(place));
      CHECK_THAT(said, Contains(bad.key.substr(bad.key.rfind('.') + 1)));
      CHECK_THAT(said, Contains(bad.says));
    }
    const Keys keys(sample);
    const std::set<std::string> tried = keys_with_bad_values(sample);
    for (const std::string& key : keys.paths) {
      if (key == "type") continue;
      CAPTURE(title(sample), key);
      const bool top = key.find('.') == std::string::npos;
      // Each key of a sample must have an invalid value: at the top level in this sample, below in any of the type.
      const auto concerns = [&](const BadValue& b) { return b.key == key || b.key.rfind(key + ".", 0) == 0; };
      const std::string plain = without_indices(key);
      const bool below = tried.count(plain) > 0 ||
                         std::any_of(tried.begin(), tried.end(),
                                     [&](const std::string& other) { return other.rfind(plain + ".", 0) == 0; });
      CHECK((top ? std::any_of(sample.bad.begin(), sample.bad.end(), concerns) : below));
      // A value of the wrong kind.
      CHECK_THAT(message(sample, changed(sample, key, "{nonsense: 1}")),
                 Contains("model.yaml:") && Contains(place) && Contains(split(plain).back()));
    }
    for (const std::string& map : keys.maps) {
      CAPTURE(title(sample), map);
      CHECK_THAT(message(sample, changed(sample, (map.empty() ? "" : map + ".") + "nonsense", "1")),
                 Contains("model.yaml:") && Contains(place) && Contains("nonsense"));
    }
  }
}

TEST_CASE("law 5: every key that a sample shows stands in the manual") {
  std::ifstream file(BIELLE_SOURCE_DIR "/mechanism/README.md");
  REQUIRE(file);
  std::set<std::string> words;
  std::string word;
  for (char c; file.get(c);) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
      word += c;
      continue;
    }
    words.insert(word);
    word.clear();
  }
  for (const Sample& sample : samples())
    for (const std::string& path : Keys(sample).paths) {
      const std::vector<std::string> parts = split(without_indices(path));
      // Keys directly below these are names that the user chooses.
      const bool is_name = parts.size() == 2 && (parts[0] == "nodes" || parts[0] == "loads");
      CAPTURE(title(sample), path);
      if (!is_name) CHECK(words.count(parts.back()) == 1);
    }
}
