#include "mechanism/language/parameters.hpp"

#include <fmt/format.h>

#include "reduce/common/input/unit.hpp"

namespace bielle::mechanism {
double evaluate(const std::string& number, const Parameters& parameters) {
  if (const auto quantity = quantity_of(number)) return to_si(*quantity, "any");
  return Expression(number, {}, parameters)(std::span<const double>());
}

Parameters read_parameters(YamlValue root, const std::map<std::string, std::string>& overrides) {
  std::vector<std::string> names;
  if (const auto section = root.find("parameters"))
    for (const auto& [name, value] : section->entries()) {
      const auto given = overrides.find(name);
      try {
        root.set_parameter(name,
                           given == overrides.end() ? value.number() : evaluate(given->second, root.parameters()));
      } catch (const std::runtime_error& error) {
        if (given == overrides.end()) throw;
        throw InputError(fmt::format("--set {}={}: {}", name, given->second, error.what()));
      }
      names.push_back(name);
    }
  for (const auto& [name, expression] : overrides)
    if (!root.parameters().count(name))
      throw InputError(fmt::format("--set {}={}: {} has no parameter '{}'{}", name, expression, root.file(), name,
                                   did_you_mean(name, names)));
  return root.parameters();
}

}  // namespace bielle::mechanism
