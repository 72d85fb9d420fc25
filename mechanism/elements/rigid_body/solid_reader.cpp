#include "mechanism/elements/rigid_body/solid_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/elements/rigid_body/solid_space.hpp"
#include "mechanism/reading/read_frame.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "mechanism/reading/solid_forms.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/superelement/inertia_tensor.hpp"

namespace bielle::mechanism {
namespace {

/// A solid of density 1, and its position.
struct UnitSolid {
  MassProperties properties;
  SolidSpace space;
};

UnitSolid read_box(const YamlValue& value) {
  const Vector3 edges = read_numbers(value, 3, "three edges [a, b, c]");
  return {box(edges), box_space(edges)};
}

UnitSolid read_sphere(const YamlValue& value) {
  const double radius = value.number();
  return {sphere(radius), sphere_space(radius)};
}

UnitSolid read_cylinder(const YamlValue& value) {
  const VectorX e = read_numbers(value, 2, "[radius, length]");
  return {cylinder(e[0], e[1]), tube_space(e[0], 0, e[1])};
}

UnitSolid read_tube(const YamlValue& value) {
  const VectorX e = read_numbers(value, 3, "[outer radius, inner radius, length]");
  if (e[1] >= e[0]) value.fail("the inner radius must be smaller than the outer one");
  return {tube(e[0], e[1], e[2]), tube_space(e[0], e[1], e[2])};
}

UnitSolid read_cone(const YamlValue& value) {
  const VectorX e = read_numbers(value, 3, "[radius below, radius above, length]");
  if (e[0] == 0 && e[1] == 0) value.fail("one of the two radii must be greater than 0");
  return {cone(e[0], e[1], e[2]), cone_space(e[0], e[1], e[2])};
}

UnitSolid read_ring(const YamlValue& value) {
  const VectorX e = read_numbers(value, 2, "[radius of the centre line, radius of the section]");
  if (e[1] > e[0]) value.fail("the radius of the section must not exceed that of the centre line");
  return {ring(e[0], e[1]), ring_space(e[0], e[1])};
}

struct Shape {
  const char* name;
  UnitSolid (*read)(const YamlValue&);
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {{"box", read_box},   {"sphere", read_sphere}, {"cylinder", read_cylinder},
                                         {"tube", read_tube}, {"cone", read_cone},     {"ring", read_ring}};
  return all;
}

struct Solid {
  MassProperties properties;  ///< negative mass if it is cut out
  double density = 0;         ///< [kg/m^3]
  PlacedSpace space;
};

Solid read_solid(const YamlValue& value) {
  const YamlValue solid = value.keyed(solid_keys());
  std::vector<std::string> names;
  const Shape* given = nullptr;
  int count = 0;
  for (const Shape& shape : shapes()) {
    names.emplace_back(shape.name);
    if (!solid.has(shape.name)) continue;
    given = &shape;
    ++count;
  }
  if (count != 1) solid.fail(fmt::format("expected exactly one of '{}'", fmt::join(names, "', '")));
  UnitSolid unit = given->read(solid.at(given->name));
  if (!solid.has("mass") && !solid.has("density")) solid.fail("a solid needs `density` or `mass`");
  if (solid.has("mass") && solid.has("density")) solid.at("mass").fail("give either `density` or `mass` of a solid");
  if (!(unit.properties.mass > 0 && std::isfinite(unit.properties.mass)))
    solid.at(given->name).fail("the volume is too large or too small for a number; lengths are in m");
  const double density =
      solid.has("mass") ? solid.at("mass").number() / unit.properties.mass : solid.at("density").number();
  if (const auto given_density = solid.find("density"); given_density && !solid.at("cut").boolean())
    warn_outside(*given_density, density, plausible_density);
  const Frame frame = read_frame(solid);
  const double signed_density = solid.at("cut").boolean() ? -density : density;
  return {placed(frame, signed_density * unit.properties), density, {std::move(unit.space), frame, signed_density}};
}

/// Checks that a cut has the density of one of the solids.
void check_cut(const YamlValue& cut, double density, const std::vector<double>& densities) {
  const auto same = [&](double other) { return std::abs(other - density) <= 1e-9 * density; };
  if (std::none_of(densities.begin(), densities.end(), same))
    cut.fail(fmt::format("what is cut out has the density {:.6g} kg/m^3, and none of the solids has it", density));
}

/// Refuses a cut that is not within material, because its mass would be subtracted all the same.
void check_empty_cuts(const YamlValue& value, const std::vector<PlacedSpace>& solids) {
  constexpr double whole = 0.999;
  for (const EmptyCut& empty : empty_cuts(solids)) {
    const YamlValue cut = value.at(empty.solid);
    const std::string why = empty.other >= 0 ? fmt::format("solid {} of the list has cut {} out already",
                                                           empty.other + 1, empty.share > whole ? "it" : "that part")
                                             : "no other solid of its density is there";
    if (empty.share > whole) cut.fail(fmt::format("there is nothing here that could be cut out: {}", why));
    cut.warn(
        fmt::format("about {:.2g} % of what this solid cuts out is not there ({}), and its mass is subtracted all the "
                    "same: what is "
                    "cut out lies inside of the other solids, and cuts do not overlap",
                    100 * empty.share, why));
  }
}

}  // namespace

const KeyTable& solid_keys() {
  using namespace keys;
  static const KeyTable table{
      "a solid", "A homogeneous solid, by its shape and its density or mass.",
      joined({solid_form_keys(),
              {{"density", number("kg/m^3").positive(), optional, "Density; a solid has either this or a `mass`."},
               {"mass", number("kg").positive(), optional, "Mass, in place of the density."}},
              own_frame_keys(),
              {{"cut", boolean(), otherwise("false"), "Whether the solid is removed from the others."}}})};
  return table;
}

MassProperties read_solids(const YamlValue& value) {
  if (!value.is_sequence()) {
    const MassProperties solid = read_solid(value).properties;
    if (solid.mass < 0) value.at("cut").fail("there is nothing that this solid is cut out of");
    return solid;
  }
  if (value.size() == 0) value.fail("expected at least one solid");
  std::vector<MassProperties> solids;
  std::vector<PlacedSpace> spaces;
  std::vector<double> densities;  ///< densities of solids with positive mass
  double mass = 0, solid_mass = 0;
  for (const YamlValue& item : value.items()) {
    auto [properties, density, space] = read_solid(item);
    if (properties.mass > 0) densities.push_back(density);
    solids.push_back(properties);
    spaces.push_back(std::move(space));
    mass += properties.mass;
    solid_mass += std::max(0.0, properties.mass);
  }
  if (!(mass > 1e-9 * solid_mass))
    value.fail(fmt::format("what is cut out leaves no mass: {:.6g} of {:.6g} kg", mass, solid_mass));
  for (std::size_t k = 0; k < solids.size(); ++k)
    if (solids[k].mass < 0) check_cut(value.at(k), read_solid(value.at(k)).density, densities);
  // Solids with positive mass come first, so that no partial sum has zero mass.
  std::stable_partition(solids.begin(), solids.end(), [](const MassProperties& p) { return p.mass > 0; });
  MassProperties sum = solids.front();
  for (std::size_t k = 1; k < solids.size(); ++k) sum = sum + solids[k];
  const std::string fault = inertia_fault(sum.inertia);
  if (!fault.empty()) value.fail(fault + ". Is all that is cut out inside of the other solids?");
  check_empty_cuts(value, spaces);
  return sum;
}

bool solids_are_placed(const YamlValue& value) {
  if (value.is_sequence()) return true;
  return value.has("position");
}

}  // namespace bielle::mechanism
