#include "mechanism/language/part_library.hpp"

#include <vector>

#include <fmt/format.h>

#include "mechanism/language/include.hpp"

namespace bielle::mechanism {

Definitions PartLibrary::definitions_of(const YamlNode& root, const std::string& file) const {
  const Definitions definitions{find_value(root, "definitions"), file};
  if (!definitions.entries) return definitions;
  for (const auto& [name, entry] : value_at(definitions.entries, "definitions", main_file_).entries())
    entry.keyed(definition_keys_);
  return definitions;
}

Part PartLibrary::find(const YamlNode& entry, const Definitions& here, const std::string& path) {
  const Tree part = find_value(entry, "part"), file = find_value(entry, "file");
  if (!part && !file) fail_at(entry, main_file_, path, "give the `part` that is placed here, or its `file`");
  Definitions definitions = here;
  if (file) {
    const std::string key = (file->file ? *file->file : main_file_) + "\n" + file->scalar;
    auto found = files_.find(key);
    if (found == files_.end()) {
      const Tree root = load_with_includes(*file, main_file_, path + ".file");
      if (root->kind != YamlNode::Kind::map) fail_at(*root, main_file_, "", "expected sections: nodes, elements, ..");
      found = files_.emplace(key, Part{root, definitions_of(*root, file->scalar)}).first;
    }
    definitions = found->second.definitions;
    if (!part) {
      if (definitions.entries && found->second.body->pairs.size() == 1)
        fail_at(*file, main_file_, path + ".file",
                fmt::format("{} has nothing but `definitions`: name the `part` among them", file->scalar));
      return found->second;
    }
  }
  std::vector<std::string> names;
  if (definitions.entries) {
    if (const Tree found = find_value(*definitions.entries, part->scalar)) return {found, definitions};
    for (const YamlNode::Pair& pair : definitions.entries->pairs) names.push_back(pair.key->scalar);
  }
  fail_at(*part, main_file_, path + ".part",
          fmt::format("there is no part '{}' among the `definitions` of {}{}", part->scalar, definitions.file,
                      names.empty() ? "" : did_you_mean(part->scalar, names)));
}

}  // namespace bielle::mechanism
