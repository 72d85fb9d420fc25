#include "reduce/body_file/body_materials.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reduce/body_file/body_axes.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

Key density_key() { return {"density", keys::number("kg/m^3").positive(), keys::required, "Mass per volume."}; }

Key axes_key() {
  return {"axes", keys::nested(axes_keys), keys::computed("the axes of the body"),
          "Directions of the material's axes 1 (x) and 2 (y) in the body."};
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
  if (const auto axes = value.find("axes"))
    material.elasticity = rotate_elasticity(material.elasticity, read_axes(*axes));
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

Eigen::Matrix<double, 6, 6> rotate_elasticity(const Eigen::Matrix<double, 6, 6>& elasticity,
                                              const Eigen::Matrix3d& rotation) {
  // Stress turns with sigma'_ij = R_im R_jn sigma_mn, written for the six components; then C' = T C T^T.
  constexpr int first[6] = {0, 1, 2, 1, 0, 0}, second[6] = {0, 1, 2, 2, 2, 1};
  Eigen::Matrix<double, 6, 6> turn;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      const int i = first[a], j = second[a], m = first[b], n = second[b];
      turn(a, b) = rotation(i, m) * rotation(j, n);
      if (m != n) turn(a, b) += rotation(i, n) * rotation(j, m);
    }
  const Eigen::Matrix<double, 6, 6> turned = turn * elasticity * turn.transpose();
  return 0.5 * (turned + turned.transpose());
}

}  // namespace bielle::reduce
