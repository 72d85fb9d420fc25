#include "reduce/mesh/gmsh/describe_solids.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include "reduce/mesh/gmsh/model.hpp"
#include "reduce/mesh/gmsh/solids.hpp"
#include "reduce/mesh/groups.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

std::vector<std::string> names_of_path(const std::string& path) {
  std::vector<std::string> names;
  std::istringstream text(path);
  for (std::string name; std::getline(text, name, '/');) names.push_back(name);
  return names;
}

std::optional<double> density_of(const BodySolid& solid, const std::vector<std::string>& groups,
                                 const std::map<std::string, double>& densities) {
  for (const auto& [region, density] : densities)
    if (region == "all" || std::count(groups.begin(), groups.end(), region) > 0 || solid.is_called(region))
      return density;
  return {};
}

}  // namespace

std::string solids_text(const std::map<int, Eigen::AlignedBox3d>& boxes, double metres,
                        const std::map<std::string, double>& densities) {
  const std::vector<PhysicalGroup> groups = physical_groups();
  gmsh::vectorpair exact;  // solids of the OpenCASCADE kernel, which know their volume
  gmsh::model::occ::getEntities(exact, 3);
  std::string text;
  std::vector<std::string> above;  // assemblies and parts whose lines stand above
  for (const BodySolid& solid : solids_of_model()) {
    std::vector<std::string> folders = names_of_path(solid.path);
    if (!folders.empty()) folders.pop_back();
    const auto [differs, until] = std::mismatch(folders.begin(), folders.end(), above.begin(), above.end());
    for (auto folder = differs; folder != folders.end(); ++folder)
      text += fmt::format("{:{}}{}\n", "", 2 + 2 * (folder - folders.begin()), *folder);
    above = folders;
    std::vector<std::string> facts;
    if (!solid.path.empty()) facts.push_back(fmt::format("'{}'", solid.name()));
    const std::vector<std::string> of_solid = groups_of(groups, 3, solid.number);
    if (std::count(exact.begin(), exact.end(), std::pair(3, solid.number)) > 0) {
      const double volume = volume_of(solid) * std::pow(metres, 3);
      facts.push_back(fmt::format("{:.6g} m^3", volume));
      if (const auto density = density_of(solid, of_solid, densities))
        facts.push_back(fmt::format("{:.6g} kg", volume * *density));
    }
    gmsh::vectorpair sides;
    gmsh::model::getBoundary({{3, solid.number}}, sides, false, false, false);
    Eigen::AlignedBox3d box;
    for (const auto& [dimension, side] : sides) box.extend(boxes.at(side));
    facts.push_back(fmt::format("from {} to {}", place_name(box.min()), place_name(box.max())));
    text += fmt::format("{:{}}volume {}: {}{}\n", "", 2 + 2 * folders.size(), solid.number, fmt::join(facts, ", "),
                        of_solid.empty() ? "" : fmt::format("; in {}", fmt::join(of_solid, ", ")));
  }
  return text.empty() ? "  none: this geometry has surfaces only and is no body\n" : text;
}

}  // namespace bielle::reduce
