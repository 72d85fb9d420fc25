#include "mechanism/language/cases.hpp"

#include <fmt/format.h>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

std::vector<std::string> case_names(const Tree& root, const std::string& file) {
  std::vector<std::string> names;
  const Tree cases = root->kind == YamlNode::Kind::map ? find_value(*root, "cases") : nullptr;
  if (!cases) return names;
  if (cases->kind != YamlNode::Kind::map) fail_at(*cases, file, "cases", "expected names of cases with their keys");
  for (const YamlNode::Pair& pair : cases->pairs) names.push_back(pair.key->scalar);
  return names;
}

Tree with_case(const Tree& root, const std::string& file, const KeyTable& keys, const std::string& chosen) {
  const Tree cases = find_value(*root, "cases");
  const std::vector<std::string> names = case_names(root, file);
  if (chosen.empty()) return cases ? without(*root, {"cases"}) : root;
  if (!is_among(chosen, names))
    throw InputError(fmt::format("--case {}: {} has no such case{}", chosen, file,
                                 names.empty() ? "" : did_you_mean(chosen, names)));
  const Tree entry = find_value(*cases, chosen);
  YamlValue::of_tree(entry, "", entry->file ? *entry->file : file)
      .keyed(keys.find("cases")->forms.front().items.front().front().table());
  Tree result = without(*root, {"cases"});
  for (const char* key : {"analysis", "output"})
    if (const Tree value = find_value(*entry, key)) result = with(*result, key, value);
  if (const Tree parameters = find_value(*entry, "parameters")) {
    Tree all = find_value(*root, "parameters");
    std::vector<std::string> known;
    if (all)
      for (const YamlNode::Pair& pair : all->pairs) known.push_back(pair.key->scalar);
    for (const YamlNode::Pair& pair : parameters->pairs) {
      if (!is_among(pair.key->scalar, known))
        fail_at(*pair.key, file, "cases." + chosen + ".parameters",
                fmt::format("'{}' is not a parameter of the file{}", pair.key->scalar,
                            did_you_mean(pair.key->scalar, known)));
      all = with(*all, pair.key->scalar, pair.value);
    }
    if (all) result = with(*result, "parameters", all);
  }
  return result;
}

}  // namespace bielle::mechanism
