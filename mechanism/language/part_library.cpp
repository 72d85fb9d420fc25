#include "mechanism/language/part_library.hpp"

#include <vector>

#include <fmt/format.h>

#include "mechanism/language/include.hpp"

namespace bielle::mechanism {

Part PartLibrary::find(const YamlNode& entry, const Definitions& here, const std::string& path) {
  const Tree part = find_value(entry, "part"), file = find_value(entry, "file");
  if (!part && !file) fail_at(entry, main_file_, path, "give the `part` that is placed here, or its `file`");
  Definitions definitions = here;
  if (file) {
    Tree& root = files_[(file->file ? *file->file : main_file_) + "\n" + file->scalar];
    if (!root) root = load_with_includes(*file, main_file_, path + ".file");
    definitions = {find_value(*root, "definitions"), file->scalar};
    if (!part) return {root, definitions};
  }
  std::vector<std::string> names;
  if (definitions.entries) {
    if (const Tree found = find_value(*definitions.entries, part->scalar)) {
      if (found->kind != YamlNode::Kind::map)
        fail_at(*found, main_file_, "definitions." + part->scalar, "expected sections: nodes, elements, ..");
      return {found, definitions};
    }
    for (const YamlNode::Pair& pair : definitions.entries->pairs) names.push_back(pair.key->scalar);
  }
  fail_at(*part, main_file_, path + ".part",
          fmt::format("there is no part '{}' among the `definitions` of {}{}", part->scalar, definitions.file,
                      names.empty() ? "" : did_you_mean(part->scalar, names)));
}

}  // namespace bielle::mechanism
