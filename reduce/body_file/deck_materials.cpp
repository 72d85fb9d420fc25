#include "reduce/body_file/deck_materials.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "reduce/body_file/body_materials.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/mesh/foreign_mesh.hpp"
#include "reduce/mesh/length_unit.hpp"

namespace bielle::reduce {

namespace {

// Mass units in kilograms. A slinch is a pound-force second squared per inch, a slug one per foot.
constexpr std::array<std::pair<const char*, double>, 6> units = {{{"kg", 1},
                                                                  {"g", 1e-3},
                                                                  {"t", 1e3},
                                                                  {"lb", 0.45359237},
                                                                  {"slug", 14.593902937206365},
                                                                  {"slinch", 175.12683524647638}}};

}  // namespace

double kilograms_per(const std::string& unit) {
  for (const auto& [name, kilograms] : units)
    if (unit == name) return kilograms;
  return 1;
}

std::vector<std::string> mass_units() {
  std::vector<std::string> names;
  for (const auto& unit : units) names.emplace_back(unit.first);
  return names;
}

std::map<std::string, std::string> read_deck_materials(const YamlValue& root, BodyFile& body) {
  const YamlValue given = root.at("materials");
  std::string text;
  try {
    text = materials_of_mesh(body.mesh.path, body.warnings);
  } catch (const InputError& error) {
    given.fail(error.what());
  }
  const std::string name = std::filesystem::path(body.mesh.path).filename().string();
  const YamlValue deck = YamlValue::parse(text, fmt::format("materials of {}", name));
  const double mass = kilograms_per(root.at("mass_unit").word());
  const double length = body.mesh.length_unit ? metres_per(*body.mesh.length_unit) : 1;
  for (const auto& [material, value] : deck.at("materials").entries()) {
    Material scaled = read_material(value);
    scaled.elasticity *= mass / length;  // force per area, with seconds
    scaled.density *= mass / std::pow(length, 3);
    warn_outside(given, scaled.elasticity.diagonal().head<3>().maxCoeff(), plausible_modulus);
    warn_outside(given, scaled.density, plausible_density);
    body.options.materials.emplace(material, scaled);
  }
  std::map<std::string, std::string> regions;
  for (const auto& [group, material] : deck.at("regions").entries()) regions[group] = material.text();
  return regions;
}

}  // namespace bielle::reduce
