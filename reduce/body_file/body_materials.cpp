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

const std::vector<std::string> isotropic_keys = {"young", "poisson"};
const std::vector<std::string> orthotropic_keys = {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"};
const std::vector<std::string> anisotropic_keys = {"stiffness"};

bool has_any(const YamlValue& value, const std::vector<std::string>& keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) { return value.has(key); });
}

std::vector<std::string> with(std::vector<std::string> keys, const std::vector<std::string>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

double poisson_ratio(const YamlValue& value) {
  const double poisson = value.number();
  if (!(poisson > -1 && poisson < 0.5))
    value.fail("expected a ratio between -1 and 0.5 (both excluded), found " + value.text());
  return poisson;
}

double density(const YamlValue& value) { return value.at("density").positive_number(); }

Material isotropic(const YamlValue& value) {
  value.check_keys(with(isotropic_keys, {"density"}), "an isotropic material");
  return Material::isotropic(value.at("young").positive_number(), poisson_ratio(value.at("poisson")), density(value));
}

Material orthotropic(const YamlValue& value) {
  value.check_keys(with(orthotropic_keys, {"density", "axes"}), "an orthotropic material");
  const auto modulus = [&](const char* key) { return value.at(key).positive_number(); };
  const auto ratio = [&](const char* key) { return value.at(key).number(); };
  return Material::orthotropic({modulus("E1"), modulus("E2"), modulus("E3")},
                               {ratio("nu23"), ratio("nu13"), ratio("nu12")},
                               {modulus("G23"), modulus("G13"), modulus("G12")}, density(value));
}

Material anisotropic(const YamlValue& value) {
  value.check_keys(with(anisotropic_keys, {"density", "axes"}), "an anisotropic material");
  return Material::anisotropic(value.at("stiffness").matrix(6, 6), density(value));
}

}  // namespace

Material read_material(const YamlValue& value) {
  const bool engineering = has_any(value, orthotropic_keys), full = has_any(value, anisotropic_keys);
  if (has_any(value, isotropic_keys) + engineering + full > 1)
    value.fail("expected the keys of one kind of material: young and poisson; or E1 .. nu12 .. G12 ..; or stiffness");
  Material material;
  try {
    material = full ? anisotropic(value) : engineering ? orthotropic(value) : isotropic(value);
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

void warn_of_material(const YamlValue& value) {
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
