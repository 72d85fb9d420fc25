#include "mechanism/language/cases.hpp"

#include <fmt/format.h>

namespace bielle::mechanism {

std::vector<std::string> case_names(const Tree& root, const std::string& file) {
  std::vector<std::string> names;
  const Tree cases = root->kind == YamlNode::Kind::map ? find_value(*root, "cases") : nullptr;
  if (!cases) return names;
  if (cases->kind != YamlNode::Kind::map) fail_at(*cases, file, "cases", "expected names of cases with their keys");
  for (const YamlNode::Pair& pair : cases->pairs) {
    const std::string& name = pair.key->scalar;
    if (name.empty() || name.find('/') != std::string::npos)
      fail_at(*pair.key, file, "cases",
              fmt::format("'{}' is no name of a case: it stands in the name of a results file", name));
    names.push_back(name);
  }
  return names;
}

namespace {

/// Checks the keys and parameters of a case, whether or not it is the chosen one. @param known  parameters of the file
void check_case(const YamlValue& entry, const KeyTable& case_keys, const std::vector<std::string>& known) {
  const YamlValue keyed = entry.keyed(case_keys);
  if (const auto parameters = keyed.find("parameters"))
    for (const auto& [name, value] : parameters->entries())
      if (!is_among(name, known))
        value.fail(fmt::format("'{}' is not a parameter of the file{}", name,
                               known.empty() ? "; it has none" : did_you_mean(name, known)));
}

}  // namespace

Tree with_case(const Tree& root, const std::string& file, const KeyTable& keys, const std::string& chosen) {
  const Tree cases = find_value(*root, "cases"), own = find_value(*root, "parameters");
  const std::vector<std::string> names = case_names(root, file);
  if (cases) {
    std::vector<std::string> known;
    if (own)
      for (const YamlNode::Pair& pair : own->pairs) known.push_back(pair.key->scalar);
    const KeyTable& table = keys.find("cases")->forms.front().items.front().front().table();
    for (const auto& [name, entry] : value_at(cases, "cases", file).entries()) check_case(entry, table, known);
  }
  if (chosen.empty()) return cases ? without(*root, {"cases"}) : root;
  if (!is_among(chosen, names))
    throw InputError(fmt::format("--case {}: {} has no such case{}", chosen, file,
                                 names.empty() ? "" : did_you_mean(chosen, names)));
  const Tree entry = find_value(*cases, chosen);
  Tree result = without(*root, {"cases"});
  for (const char* key : {"analysis", "output"})
    if (const Tree value = find_value(*entry, key)) result = with(*result, key, value);
  if (const Tree parameters = find_value(*entry, "parameters"); parameters && own) {
    Tree all = own;
    for (const YamlNode::Pair& pair : parameters->pairs) all = with(*all, pair.key->scalar, pair.value);
    result = with(*result, "parameters", all);
  }
  return result;
}

}  // namespace bielle::mechanism
