#include "mechanism/drawing/reading/colour.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the names of CSS with their values.
const std::map<std::string, std::string>& colour_names() {
  static const std::map<std::string, std::string> names = {
      {"black", "#000000"},     {"white", "#ffffff"},     {"gray", "#808080"},      {"grey", "#808080"},
      {"silver", "#c0c0c0"},    {"lightgray", "#d3d3d3"}, {"darkgray", "#a9a9a9"},  {"red", "#ff0000"},
      {"darkred", "#8b0000"},   {"maroon", "#800000"},    {"orange", "#ffa500"},    {"gold", "#ffd700"},
      {"yellow", "#ffff00"},    {"olive", "#808000"},     {"lime", "#00ff00"},      {"green", "#008000"},
      {"darkgreen", "#006400"}, {"teal", "#008080"},      {"cyan", "#00ffff"},      {"aqua", "#00ffff"},
      {"lightblue", "#add8e6"}, {"skyblue", "#87ceeb"},   {"steelblue", "#4682b4"}, {"blue", "#0000ff"},
      {"navy", "#000080"},      {"purple", "#800080"},    {"magenta", "#ff00ff"},   {"fuchsia", "#ff00ff"},
      {"pink", "#ffc0cb"},      {"brown", "#a52a2a"},     {"tan", "#d2b48c"},       {"beige", "#f5f5dc"}};
  return names;
}

}  // namespace

std::string read_colour(const YamlValue& value) {
  std::string colour = value.text();
  std::transform(colour.begin(), colour.end(), colour.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (colour.starts_with('#')) {
    const bool is_value = colour.size() == 7 && std::all_of(colour.begin() + 1, colour.end(),
                                                            [](unsigned char c) { return std::isxdigit(c); });
    if (!is_value) value.fail(fmt::format("expected a colour, \"#rrggbb\" of six digits 0 to f, found '{}'", colour));
    return colour;
  }
  const auto found = colour_names().find(colour);
  if (found != colour_names().end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, is] : colour_names()) names.push_back(name);
  value.fail(fmt::format("'{}' is none of the names of colours that are known here; any colour is \"#rrggbb\"{}",
                         value.text(), did_you_mean(colour, names)));
}

}  // namespace bielle::mechanism
