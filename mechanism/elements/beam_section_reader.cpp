// Cross sections in the mechanism file.
#include <algorithm>
#include <array>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "mechanism/elements/beam_section.hpp"
#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {
namespace {

// Order of the numbers of a homogeneous shape: dimensions, then these.
enum Tail { young, shear, density, shear_y, shear_z, offset_y, offset_z, tail_size };

constexpr std::array constants_keys{"EA", "GAy", "GAz", "GJ", "EIy", "EIz"};
constexpr std::array mass_keys{"mass_per_length", "Jx", "Jy", "Jz"};

double shear_modulus(const YamlValue& value, double young_modulus) {
  const auto modulus = value.find("shear"), poisson = value.find("poisson");
  if (modulus && poisson) modulus->fail("give either `shear` or `poisson`");
  if (modulus) return modulus->positive_number();
  if (!poisson) value.fail("a section of a shape needs `poisson` or `shear`");
  const double nu = poisson->number();
  if (!(nu > -1 && nu <= 0.5)) poisson->fail(fmt::format("Poisson's ratio lies in (-1, 0.5]; found {:.6g}", nu));
  return young_modulus / (2 * (1 + nu));
}

VectorX positive_list(const YamlValue& value, std::size_t count, const std::string& expected) {
  if (!value.is_sequence() || value.size() != count) value.fail("expected " + expected);
  VectorX numbers(static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) numbers[static_cast<Eigen::Index>(k)] = value.at(k).positive_number();
  return numbers;
}

VectorX shape_dimensions(const std::string& kind, const YamlValue& value) {
  if (kind == "rectangle") return positive_list(value, 2, "[width_y, height_z]");
  if (kind == "circle") return VectorX::Constant(1, value.positive_number());
  const VectorX radii = positive_list(value, 2, "[outer radius, inner radius]");
  if (radii[1] >= radii[0]) value.fail("the inner radius must be smaller than the outer one");
  return radii;
}

SectionConstants shape_constants(const std::string& kind, const VectorX& numbers) {
  if (kind == "rectangle") return rectangle_constants(numbers[0], numbers[1]);
  if (kind == "circle") return tube_constants(numbers[0], 0);
  return tube_constants(numbers[0], numbers[1]);
}

VectorX read_shape(const std::string& kind, const YamlValue& value) {
  value.check_keys({kind, "young", "poisson", "shear", "density", "shear_factors", "offset"},
                   "a section '" + kind + "'");
  const VectorX dimensions = shape_dimensions(kind, value.at(kind));
  VectorX tail = VectorX::Zero(tail_size);
  tail[young] = value.at("young").positive_number();
  tail[shear] = shear_modulus(value, tail[young]);
  if (const auto rho = value.find("density")) tail[density] = rho->non_negative_number();
  const SectionConstants k = shape_constants(kind, dimensions);
  tail[shear_y] = k.k_y;
  tail[shear_z] = k.k_z;
  if (const auto factors = value.find("shear_factors"))
    tail.segment<2>(shear_y) = positive_list(*factors, 2, "[k_y, k_z]");
  if (const auto offset = value.find("offset")) {
    const Eigen::VectorXd o = offset->vector();
    if (o.size() != 2) offset->fail("expected the centroid [y, z] from the node line");
    tail.segment<2>(offset_y) = o;
  }
  VectorX numbers(dimensions.size() + tail_size);
  numbers << dimensions, tail;
  return numbers;
}

VectorX read_constants(const YamlValue& value) {
  std::vector<std::string> keys(constants_keys.begin(), constants_keys.end());
  keys.insert(keys.end(), mass_keys.begin(), mass_keys.end());
  value.check_keys(keys, "a section by constants");
  VectorX numbers = VectorX::Zero(10);
  for (int k = 0; k < 6; ++k) numbers[k] = value.at(constants_keys[static_cast<std::size_t>(k)]).positive_number();
  const bool has_mass =
      std::any_of(mass_keys.begin(), mass_keys.end(), [&](const char* key) { return value.has(key); });
  if (!has_mass) return numbers;
  for (int k = 0; k < 4; ++k) {
    const YamlValue item = value.at(mass_keys[static_cast<std::size_t>(k)]);
    numbers[6 + k] = item.non_negative_number();
    // Without rotary inertia the section's rotation would have no mass at all.
    if (numbers[6] > 0 && numbers[6 + k] == 0) item.fail("a section with mass has mass moments > 0 about all its axes");
  }
  return numbers;
}

void check_positive_definite(const YamlValue& value, const MatrixX& A, const std::string& what) {
  const double largest = A.cwiseAbs().maxCoeff();
  if (!(A - A.transpose()).isZero(1e-9 * largest)) value.fail(what + " must be symmetric");
  // Scaled to a unit diagonal: translations and rotations have different units.
  const VectorX scale = A.diagonal().cwiseMax(0).cwiseSqrt();
  const bool positive =
      scale.minCoeff() > 0 &&
      Eigen::LLT<MatrixX>(scale.cwiseInverse().asDiagonal() * A * scale.cwiseInverse().asDiagonal()).info() ==
          Eigen::Success;
  if (!positive) value.fail(what + " must be positive definite");
}

/// Mass, offset and inertia of [[m I, -m c~], [m c~, J]], J about the node line.
void take_apart(const Matrix6& M, BeamSection& section) {
  section.mass = M.topLeftCorner<3, 3>().trace() / 3;
  section.mass_offset =
      section.mass > 0 ? Vector3(skew_vector(M.bottomLeftCorner<3, 3>()) / section.mass) : Vector3::Zero();
  const Matrix3 c = skew(section.mass_offset);
  section.inertia = M.bottomRightCorner<3, 3>() + section.mass * c * c;
}

void check_mass(const YamlValue& value, const Matrix6& M) {
  BeamSection section;
  take_apart(M, section);
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
  value.check_keys({"stiffness", "mass"}, "a section by matrices");
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

}  // namespace

SectionLaw::Definition SectionLaw::read(const YamlValue& value) {
  const std::vector<std::string> kinds = {"rectangle", "circle", "tube", "EA", "stiffness"};
  std::vector<std::string> given;
  if (!value.is_map()) value.fail("expected a section: a map, or a pair [start, end] of maps");
  std::copy_if(kinds.begin(), kinds.end(), std::back_inserter(given),
               [&](const std::string& k) { return value.has(k); });
  if (given.size() != 1)
    value.fail(
        "expected exactly one of `rectangle`, `circle`, `tube`, the constants `EA`, `GAy`, ..., or a 6x6 `stiffness`");
  const std::string& kind = given.front();
  if (kind == "EA") return {kind, read_constants(value)};
  if (kind == "stiffness") return {kind, read_matrices(value)};
  return {kind, read_shape(kind, value)};
}

BeamSection SectionLaw::evaluate(const std::string& kind, const VectorX& numbers) {
  BeamSection section;
  if (kind == "EA") {
    section.stiffness = numbers.head<6>().asDiagonal();
    section.mass = numbers[6];
    section.inertia = numbers.segment<3>(7).asDiagonal();
  } else if (kind == "stiffness") {
    section.stiffness = numbers.head<36>().reshaped(6, 6);
    take_apart(numbers.tail<36>().reshaped(6, 6), section);
  } else {
    const VectorX tail = numbers.tail<tail_size>();
    SectionConstants k = shape_constants(kind, numbers);
    k.k_y = tail[shear_y];
    k.k_z = tail[shear_z];
    return BeamSection::homogeneous(k, tail[young], tail[shear], tail[density], tail[offset_y], tail[offset_z]);
  }
  return section;
}

SectionLaw::SectionLaw(const YamlValue& value) {
  if (!value.is_sequence()) {
    start_ = end_ = read(value);
    return;
  }
  if (value.size() != 2) value.fail("expected a section or a pair [start, end]");
  start_ = read(value.at(std::size_t{0}));
  end_ = read(value.at(std::size_t{1}));
  if (start_.kind != end_.kind)
    value.fail(
        fmt::format("a beam cannot taper from '{}' to '{}': both ends must be of one kind", start_.kind, end_.kind));
}

BeamSection SectionLaw::at(double s) const {
  return evaluate(start_.kind, (1 - s) * start_.numbers + s * end_.numbers);
}

}  // namespace bielle::mechanism
