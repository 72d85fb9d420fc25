// Reader of cross sections in the mechanism file.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "mechanism/elements/beam/beam_section.hpp"
#include "mechanism/elements/beam/section_keys.hpp"
#include "mechanism/math/gauss.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/reading/read_numbers.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/dense/symmetric_factors.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::array constants_keys{"EA", "GAy", "GAz", "GJ", "EIy", "EIz"};
constexpr std::array mass_keys{"mass_per_length", "Jx", "Jy", "Jz"};

double shear_modulus(const YamlValue& value, double young_modulus) {
  const auto modulus = value.find("shear"), poisson = value.find("poisson");
  if (modulus && poisson) modulus->fail("give either `shear` or `poisson`");
  if (modulus) return modulus->number();
  if (!poisson) value.fail("a section of a shape needs `poisson` or `shear`");
  return young_modulus / (2 * (1 + poisson->number()));
}

Vector2 read_offset(const YamlValue& value, const std::string& what) {
  return read_numbers(value.at("offset"), 2, fmt::format("{} [y, z] from the node line", what));
}

VectorX read_constants(const YamlValue& value) {
  VectorX numbers = VectorX::Zero(10);
  for (int k = 0; k < 6; ++k) numbers[k] = value.at(constants_keys[static_cast<std::size_t>(k)]).number();
  const bool has_mass =
      std::any_of(mass_keys.begin(), mass_keys.end(), [&](const char* key) { return value.has(key); });
  if (!has_mass) return numbers;
  for (int k = 0; k < 4; ++k) {
    const YamlValue item = value.at(mass_keys[static_cast<std::size_t>(k)]);
    numbers[6 + k] = item.number();
    // Without rotary inertia the section's rotation would have no mass.
    if (numbers[6] > 0 && numbers[6 + k] == 0) item.fail("a section with mass has mass moments > 0 about all its axes");
    if (numbers[6] == 0 && numbers[6 + k] > 0) item.fail("a section without mass has no mass moments");
  }
  return numbers;
}

void check_positive_definite(const YamlValue& value, const MatrixX& A, const std::string& what) {
  const double largest = A.cwiseAbs().maxCoeff();
  if (!(A - A.transpose()).isZero(1e-9 * largest)) value.fail(fmt::format("{} must be symmetric", what));
  // The matrix is scaled to a unit diagonal: translations and rotations have different units.
  const VectorX scale = A.diagonal().cwiseMax(0).cwiseSqrt();
  const bool positive = scale.minCoeff() > 0 &&
                        is_positive_definite(scale.cwiseInverse().asDiagonal() * A * scale.cwiseInverse().asDiagonal());
  if (!positive) value.fail(fmt::format("{} must be positive definite", what));
}

void check_mass(const YamlValue& value, const Matrix6& M) {
  BeamSection section;
  section.set_mass(M);
  if (!(section.mass > 0)) value.fail("the mass per length must be > 0");
  Matrix6 rigid = Matrix6::Zero();
  const Matrix3 mc = section.mass * skew(section.mass_offset);
  rigid << section.mass * Matrix3::Identity(), -mc, mc, M.bottomRightCorner<3, 3>();
  if (!(rigid - M).isZero(1e-9 * M.cwiseAbs().maxCoeff()))
    value.fail(
        "no section has this mass matrix: expected [[m I, -m c~], [m c~, J]] with the mass m per length and the offset "
        "c of the centre of mass");
  check_positive_definite(value, section.inertia, "the section's inertia about its centre of mass");
}

VectorX read_matrices(const YamlValue& value) {
  const YamlValue stiffness = value.at("stiffness");
  const Matrix6 C = stiffness.matrix(6, 6);
  check_positive_definite(stiffness, C, "a section's stiffness");
  VectorX numbers = VectorX::Zero(72);
  numbers.head<36>() = C.reshaped();
  if (const auto mass = value.find("mass")) {
    const Matrix6 M = mass->matrix(6, 6);
    check_mass(*mass, M);
    numbers.tail<36>() = M.reshaped();
  }
  return numbers;
}

/// Returns the only key that defines the section.
std::string kind_of(const YamlValue& value) {
  std::vector<std::string> kinds = section_shape_names(), given;
  kinds.emplace_back("EA");
  kinds.emplace_back("stiffness");
  std::copy_if(kinds.begin(), kinds.end(), std::back_inserter(given),
               [&](const std::string& k) { return value.has(k); });
  if (given.size() == 1) return given.front();
  if (given.size() > 1)
    value.at(given[1]).fail(fmt::format("a section is given by one of `{}` and `{}`, not by both", given[0], given[1]));
  const auto is_known = [&](const std::string& key) {
    return shape_section_keys().find(key) || constants_section_keys().find(key) || matrices_section_keys().find(key);
  };
  for (const auto& [key, item] : value.entries())
    if (!is_known(key)) item.fail(fmt::format("'{}' is no kind of section{}", key, did_you_mean(key, kinds)));
  value.fail(
      "expected exactly one of `rectangle`, `circle`, `tube`, `i`, `t`, `l`, `box`, the constants `EA`, `GAy`, ..., or "
      "a 6x6 `stiffness`");
}

}  // namespace

SectionLaw::Definition SectionLaw::read_shape(const std::string& kind, const YamlValue& value) {
  Definition d;
  d.kind = kind;
  d.numbers = read_shape_dimensions(kind, value.at(kind));
  const double young = value.at("young").number(), density = value.at("density").number();
  warn_outside(value.at("young"), young, plausible_modulus);
  if (density > 0) warn_outside(value.at("density"), density, plausible_density);
  d.material = Vector3(young, shear_modulus(value, young), density);
  d.offset = read_offset(value, "the centroid");
  d.has_density = value.has("density");
  d.has_offset = value.has("offset");
  if (const auto factors = value.find("shear_factors")) d.shear_factors = read_numbers(*factors, 2, "[k_y, k_z]");
  if (const auto points = value.find("stress_points")) {
    if (points->items().empty()) points->fail("expected at least one point [y, z]; leave the key out for none");
    d.points.resize(static_cast<Eigen::Index>(2 * points->items().size()));
    Eigen::Index k = 0;
    for (const YamlValue& item : points->items()) {
      const Vector2 point = read_numbers(item, 2, "a point [y, z] of the section, from its centroid");
      if (!shape_contains(kind, d.numbers, point))
        item.fail("the point lies outside of the section; y and z count from its centroid");
      d.points.segment<2>(k) = point;
      k += 2;
    }
  }
  return d;
}

SectionLaw::Definition SectionLaw::read(const YamlValue& given) {
  if (!given.is_map()) given.fail("expected a section: a map, or a pair [start, end] of maps");
  const std::string kind = kind_of(given);
  if (kind != "EA" && kind != "stiffness") return read_shape(kind, given.keyed(shape_section_keys()));
  const YamlValue value = given.keyed(kind == "EA" ? constants_section_keys() : matrices_section_keys());
  Definition d;
  d.kind = kind;
  d.numbers = kind == "EA" ? read_constants(value) : read_matrices(value);
  d.offset = read_offset(value, "the section's origin");
  d.has_density = value.has("mass_per_length") || value.has("mass");
  d.has_offset = value.has("offset");
  return d;
}

void SectionLaw::check_taper(const YamlValue& value, const Definition& start, const Definition& end) {
  if (start.kind != end.kind)
    value.fail(
        fmt::format("a beam cannot taper from '{}' to '{}': both ends must be of one kind", start.kind, end.kind));
  if (start.shear_factors.size() != end.shear_factors.size())
    value.fail("give `shear_factors` at both ends, or at none");
  if (start.points.size() != end.points.size()) value.fail("give as many `stress_points` at the end as at the start");
  // A missing key counts as zero: a taper to zero would be a mistake.
  if (start.has_density != end.has_density) value.fail("give the density or mass at both ends, or at none");
  if (start.has_offset != end.has_offset) value.fail("give `offset` at both ends, or at none");
}

}  // namespace bielle::mechanism
