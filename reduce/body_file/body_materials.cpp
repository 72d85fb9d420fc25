#include "reduce/body_file/body_materials.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reduce/body_file/body_axes.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/common/input/yaml_file.hpp"
#include "reduce/fe/elasticity.hpp"

namespace bielle::reduce {

namespace {

Key density_key() { return {"density", keys::number("kg/m^3").positive(), keys::required, "Mass per volume."}; }

const KeyTable& wound_axes_keys() {
  using namespace keys;
  static const KeyTable table{
      "axes around a line",
      "Axes of a wound part, which turn with the place around a line: in them a direction is `[radial, around, "
      "along]`. "
      "Each cell has the axes of its centroid.",
      {{"point", vector3("m"), required, "A point of the line."},
       {"axis", direction(), required, "Direction of the line; `along` is this direction."},
       {"x", direction(), computed("[0, 1, 0], around the line"), "Direction of the material's axis 1."},
       {"y", direction(), computed("[0, 0, 1], along the line"),
        "Direction of the material's axis 2, which is made normal to x."}}};
  return table;
}

Key axes_key() {
  return {"axes",
          {keys::nested(axes_keys), keys::nested(wound_axes_keys)},
          keys::computed("the axes of the body"),
          "Directions of the material's axes 1 (x) and 2 (y) in the body, or around a line."};
}

const KeyTable& isotropic_keys() {
  using namespace keys;
  static const KeyTable table{"an isotropic material",
                              "A material that is equally stiff in all directions.",
                              {{"young", number("Pa").positive(), required, "Young's modulus."},
                               {"poisson", number().inside(-1, 0.5), required, "Poisson's ratio."},
                               density_key()}};
  return table;
}

std::vector<Key> orthotropic_constants() {
  using namespace keys;
  const auto modulus = [](const char* name, const char* about) {
    return Key{name, number("Pa").positive(), required, about};
  };
  return {modulus("E1", "Young's modulus along axis 1."),
          modulus("E2", "Young's modulus along axis 2."),
          modulus("E3", "Young's modulus along axis 3."),
          {"nu12", number(), required, "Contraction along 2 by stress along 1: nu12 / E1 = nu21 / E2."},
          {"nu13", number(), required, "Contraction along 3 by stress along 1."},
          {"nu23", number(), required, "Contraction along 3 by stress along 2."},
          modulus("G12", "Shear modulus in the plane of axes 1 and 2."),
          modulus("G13", "Shear modulus in the plane of axes 1 and 3."),
          modulus("G23", "Shear modulus in the plane of axes 2 and 3.")};
}

const KeyTable& orthotropic_keys() {
  using namespace keys;
  static const KeyTable table{"an orthotropic material",
                              "A material with three planes of symmetry, such as a fibre composite.",
                              joined({orthotropic_constants(), {density_key(), axes_key()}})};
  return table;
}

const KeyTable& anisotropic_keys() {
  using namespace keys;
  static const KeyTable table{"an anisotropic material",
                              "A material of any elasticity, such as a crystal.",
                              {{"stiffness", matrix(6, 6, "Pa"), required,
                                "Stiffness, symmetric, in the order xx yy zz yz xz xy with engineering shear strains."},
                               density_key(),
                               axes_key()}};
  return table;
}

bool has_any(const YamlValue& value, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return value.has(name); });
}

bool is_orthotropic(const YamlValue& value) { return has_any(value, keys::names_of(orthotropic_constants())); }

/// Returns the material bound to the keys of its kind. @throws InputError when it has keys of two kinds
YamlValue of_its_kind(const YamlValue& value) {
  const bool isotropic = has_any(value, {"young", "poisson"}), full = value.has("stiffness");
  const bool engineering = is_orthotropic(value);
  if (isotropic + engineering + full > 1)
    value.fail("expected the keys of one kind of material: young and poisson; or E1 .. nu12 .. G12 ..; or stiffness");
  return value.keyed(full ? anisotropic_keys() : engineering ? orthotropic_keys() : isotropic_keys());
}

Material made_of(const YamlValue& material) {
  const auto constant = [&](const char* key) { return material.at(key).number(); };
  if (material.has("stiffness"))
    return Material::anisotropic(material.at("stiffness").matrix(6, 6), constant("density"));
  if (!is_orthotropic(material))
    return Material::isotropic(constant("young"), constant("poisson"), constant("density"));
  return Material::orthotropic({constant("E1"), constant("E2"), constant("E3")},
                               {constant("nu23"), constant("nu13"), constant("nu12")},
                               {constant("G23"), constant("G13"), constant("G12")}, constant("density"));
}

void set_axes(const YamlValue& given, Material& material) {
  const bool wound = given.is_map() && (given.has("axis") || given.has("point"));
  const YamlValue axes = given.keyed(wound ? wound_axes_keys() : axes_keys());
  if (!wound) {
    material.elasticity = rotate_elasticity(material.elasticity, read_axes(axes));
    return;
  }
  const auto x = axes.find("x"), y = axes.find("y");
  const Eigen::Matrix3d in_wound =
      triad(x ? x->direction() : Eigen::Vector3d::UnitY(), y ? y->direction() : Eigen::Vector3d::UnitZ(), axes);
  material.elasticity = rotate_elasticity(material.elasticity, in_wound);
  material.winding_point = axes.at("point").vector3();
  material.winding_axis = axes.at("axis").direction();
}

}  // namespace

KeyForms material_forms() {
  return {keys::nested(isotropic_keys), keys::nested(orthotropic_keys), keys::nested(anisotropic_keys)};
}

Material read_material(const YamlValue& given) {
  const YamlValue value = of_its_kind(given);
  Material material;
  try {
    material = made_of(value);
  } catch (const InputError& error) {
    // Messages about single keys contain the place already; messages about the material as a whole do not.
    const std::string message = error.what();
    if (message.starts_with(value.file() + ":")) throw;
    value.fail(message);
  }
  if (const auto axes = value.find("axes")) set_axes(*axes, material);
  return material;
}

void warn_of_material(const YamlValue& given) {
  const YamlValue value = of_its_kind(given);
  for (const char* key : {"young", "E1", "E2", "E3", "G12", "G13", "G23"})
    if (const auto modulus = value.find(key)) warn_outside(*modulus, modulus->number(), plausible_modulus);
  if (const auto stiffness = value.find("stiffness"))
    warn_outside(*stiffness, stiffness->matrix(6, 6).diagonal().maxCoeff(), plausible_modulus);
  const YamlValue density = value.at("density");
  warn_outside(density, density.number(), plausible_density);
}

}  // namespace bielle::reduce
