#include "mechanism/language/scope.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/language/parameters.hpp"
#include "mechanism/reading/functions_of_names.hpp"
#include "reduce/common/formula/formula_parser.hpp"
#include "reduce/common/formula/formula_references.hpp"
#include "reduce/common/input/unit.hpp"

namespace bielle::mechanism {
namespace {

std::string literal(double value) { return value < 0 ? fmt::format("({})", value) : fmt::format("{}", value); }

}  // namespace

void check_word(const std::string& name, const YamlNode& place, const std::string& main_file, const std::string& path) {
  if (!is_dotted_word(name) || name.find('.') != std::string::npos)
    fail_at(place, main_file, path,
            fmt::format("'{}' is no name in formulas: letters, digits and '_', no digit first", name));
  if (name == "t" || is_among(name, built_in_names()))
    fail_at(place, main_file, path, fmt::format("'{}' has a meaning in formulas already; choose another name", name));
}

Scope Scope::inner() const {
  Scope scope;
  scope.outer = this;
  scope.main_file = main_file;
  scope.parameters = parameters;
  scope.prefix = prefix;
  scope.placement = placement;
  return scope;
}

bool Scope::replaces() const {
  return !words.empty() || !values.empty() || !own.empty() || !merged.empty() || (outer && outer->replaces());
}

std::optional<std::string> Scope::name_of(const std::string& name) const {
  // Finds the longest beginning that is a name: "left arm", "left arm.angle", "bay_2.root".
  for (std::size_t end = name.size();; end = name.rfind('.', end - 1)) {
    if (end == std::string::npos || end == 0) break;
    const std::string beginning = name.substr(0, end);
    if (const auto found = merged.find(beginning); found != merged.end())
      return found->second->scalar + name.substr(end);
    if (own.count(beginning)) return prefix + name;
  }
  return outer ? outer->name_of(name) : std::nullopt;
}

std::string Scope::formula(const std::string& text, const std::vector<std::string>& variables) const {
  const auto replaced = [&](const std::string& word) -> std::optional<std::string> {
    if (std::find(variables.begin(), variables.end(), word) != variables.end()) return {};
    for (const Scope* scope = this; scope; scope = scope->outer) {
      if (const auto found = scope->values.find(word); found != scope->values.end()) return literal(found->second);
      if (scope->measures.count(word)) return scope->prefix + word;
    }
    return {};
  };
  return rename_in_formula(
      text, functions_of_names(), [&](const std::string& name) { return name_of(name); }, replaced);
}

const std::string* Scope::word_of(const std::string& name) const {
  for (const Scope* scope = this; scope; scope = scope->outer)
    if (const auto found = scope->words.find(name); found != scope->words.end()) return &found->second;
  return nullptr;
}

std::string Scope::text(const YamlNode& node, const std::string& path) const {
  std::string text = node.scalar;
  for (std::size_t begin = 0; (begin = text.find('{', begin)) != std::string::npos;) {
    const std::size_t end = text.find('}', begin);
    if (end == std::string::npos) fail_at(node, *main_file, path, fmt::format("'{}': a brace is not closed", text));
    if (const std::string* word = word_of(text.substr(begin + 1, end - begin - 1))) {
      text.replace(begin, end - begin + 1, *word);
      begin += word->size();
      continue;
    }
    const YamlNode inside{
        YamlNode::Kind::scalar, node.line, node.file, text.substr(begin + 1, end - begin - 1), {}, {}};
    const double value = number(inside, path);
    if (value != std::floor(value) || std::abs(value) > 1e15)
      fail_at(node, *main_file, path,
              fmt::format("'{{{}}}' is {}; a name contains whole numbers", inside.scalar, value));
    const std::string digits = fmt::format("{:.0f}", value);
    text.replace(begin, end - begin + 1, digits);
    begin += digits.size();
  }
  return text;
}

double Scope::number(const YamlNode& node, const std::string& path) const {
  if (node.kind != YamlNode::Kind::scalar) fail_at(node, *main_file, path, "expected a number");
  // Most numbers are plain; the parser of formulas would take 30 us.
  if (const auto plain = plain_number(node.scalar)) return *plain;
  try {
    return evaluate(quantity_of(node.scalar) ? node.scalar : formula(node.scalar, {}), *parameters);
  } catch (const std::runtime_error& error) {
    fail_at(node, *main_file, path, fmt::format("'{}': {}", node.scalar, error.what()));
  }
}

std::optional<double> Scope::constant(const YamlNode& node, const std::string& path) const {
  if (node.kind != YamlNode::Kind::scalar) return {};
  if (const auto plain = plain_number(node.scalar)) return plain;
  bool is_constant = node.scalar.find_first_of("'\"") == std::string::npos;  // neither a file nor a name
  rename_in_formula(
      quantity_of(node.scalar) ? "" : node.scalar, functions_of_names(),
      [&](const std::string&) -> std::optional<std::string> { return is_constant = false, std::nullopt; },
      [&](const std::string& word) -> std::optional<std::string> {
        is_constant = is_constant && (parameters->count(word) || is_among(word, built_in_names()));
        return {};
      });
  return is_constant ? std::optional(number(node, path)) : std::nullopt;
}

}  // namespace bielle::mechanism
