// Cross sections in the mechanism file.
#include <algorithm>
#include <array>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "mechanism/elements/beam_section.hpp"
#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {
namespace {

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

Vector2 positive_pair(const YamlValue& value, const std::string& expected) {
  if (!value.is_sequence() || value.size() != 2) value.fail("expected " + expected);
  return {value.at(std::size_t{0}).positive_number(), value.at(std::size_t{1}).positive_number()};
}

/// (2), zero when absent.
Vector2 read_offset(const YamlValue& value, const std::string& what) {
  const auto offset = value.find("offset");
  if (!offset) return Vector2::Zero();
  const VectorX numbers = offset->vector();
  if (numbers.size() != 2) offset->fail("expected " + what + " [y, z] from the node line");
  return numbers;
}

VectorX read_constants(const YamlValue& value) {
  std::vector<std::string> keys(constants_keys.begin(), constants_keys.end());
  keys.insert(keys.end(), mass_keys.begin(), mass_keys.end());
  keys.emplace_back("offset");
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
  value.check_keys({"stiffness", "mass", "offset"}, "a section by matrices");
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

SectionLaw::Definition SectionLaw::read_shape(const std::string& kind, const YamlValue& value) {
  value.check_keys({kind, "young", "poisson", "shear", "density", "shear_factors", "offset", "stress_points"},
                   "a section '" + kind + "'");
  Definition d;
  d.kind = kind;
  d.numbers = read_shape_dimensions(kind, value.at(kind));
  const double young = value.at("young").positive_number();
  const auto density = value.find("density");
  d.material = Vector3(young, shear_modulus(value, young), density ? density->non_negative_number() : 0);
  d.offset = read_offset(value, "the centroid");
  d.has_density = density.has_value();
  d.has_offset = value.has("offset");
  if (const auto factors = value.find("shear_factors")) d.shear_factors = positive_pair(*factors, "[k_y, k_z]");
  if (const auto points = value.find("stress_points")) {
    const auto shape = make_section_shape(kind, d.numbers);
    d.points.resize(static_cast<Eigen::Index>(2 * points->items().size()));
    Eigen::Index k = 0;
    for (const YamlValue& item : points->items()) {
      const Eigen::VectorXd point = item.vector();
      if (point.size() != 2) item.fail("expected a point [y, z] of the section, from its centroid");
      if (!shape->contains(point)) item.fail("the point lies outside of the section; y and z count from its centroid");
      d.points.segment<2>(k) = point;
      k += 2;
    }
  }
  return d;
}

SectionLaw::Definition SectionLaw::read(const YamlValue& value) {
  if (!value.is_map()) value.fail("expected a section: a map, or a pair [start, end] of maps");
  std::vector<std::string> kinds = section_shape_names(), given;
  kinds.insert(kinds.end(), {"EA", "stiffness"});
  std::copy_if(kinds.begin(), kinds.end(), std::back_inserter(given),
               [&](const std::string& k) { return value.has(k); });
  if (given.size() != 1)
    value.fail(
        "expected exactly one of `rectangle`, `circle`, `tube`, `i`, `t`, `l`, `box`, the constants `EA`, `GAy`, ..., "
        "or a "
        "6x6 `stiffness`");
  const std::string& kind = given.front();
  if (kind != "EA" && kind != "stiffness") return read_shape(kind, value);
  Definition d;
  d.kind = kind;
  d.numbers = kind == "EA" ? read_constants(value) : read_matrices(value);
  d.offset = read_offset(value, "the section's origin");
  d.has_density = value.has("mass_per_length") || value.has("mass");
  d.has_offset = value.has("offset");
  return d;
}

BeamSection SectionLaw::evaluate(const Definition& d) const {
  BeamSection section;
  if (d.kind == "EA") {
    section.stiffness = d.numbers.head<6>().asDiagonal();
    section.mass = d.numbers[6];
    section.inertia = d.numbers.segment<3>(7).asDiagonal();
    return section.shifted(d.offset);
  }
  if (d.kind == "stiffness") {
    section.stiffness = d.numbers.head<36>().reshaped(6, 6);
    take_apart(d.numbers.tail<36>().reshaped(6, 6), section);
    return section.shifted(d.offset);
  }
  const auto shape = make_section_shape(d.kind, d.numbers);
  SectionConstants k = shape->constants();
  if (d.shear_factors.size() == 2) k.shear_area = k.A * d.shear_factors.asDiagonal().toDenseMatrix();
  section = BeamSection::homogeneous(k, d.material[0], d.material[1], d.material[2], d.offset);
  for (Eigen::Index p = 0; p < d.points.size(); p += 2) {
    const Vector2 point = d.points.segment<2>(p);
    // The centroid of a tapered t or l does not move linearly.
    if (!shape->contains(point))
      value_.fail(
          fmt::format("stress point {} lies outside of the section somewhere between start and end", p / 2 + 1));
    section.stress.push_back(shape->stress(point, d.offset));
  }
  return section;
}

void SectionLaw::check_taper(const YamlValue& value, const Definition& start, const Definition& end) {
  if (start.kind != end.kind)
    value.fail(
        fmt::format("a beam cannot taper from '{}' to '{}': both ends must be of one kind", start.kind, end.kind));
  if (start.shear_factors.size() != end.shear_factors.size())
    value.fail("give `shear_factors` at both ends, or at none");
  if (start.points.size() != end.points.size()) value.fail("give as many `stress_points` at the end as at the start");
  // What is left out counts as zero: a taper to nothing would be a slip.
  if (start.has_density != end.has_density) value.fail("give the density or mass at both ends, or at none");
  if (start.has_offset != end.has_offset) value.fail("give `offset` at both ends, or at none");
}

SectionLaw::SectionLaw(const YamlValue& value) : value_(value) {
  if (!value.is_sequence()) {
    start_ = end_ = read(value);
    uniform_ = evaluate(start_);
    return;
  }
  if (value.size() != 2) value.fail("expected a section or a pair [start, end]");
  start_ = read(value.at(std::size_t{0}));
  end_ = read(value.at(std::size_t{1}));
  check_taper(value, start_, end_);
}

SectionLaw::Definition SectionLaw::between(double s) const {
  const auto mix = [s](const VectorX& a, const VectorX& b) { return VectorX((1 - s) * a + s * b); };
  Definition d = start_;
  d.numbers = mix(start_.numbers, end_.numbers);
  d.material = mix(start_.material, end_.material);
  d.offset = mix(start_.offset, end_.offset);
  d.shear_factors = mix(start_.shear_factors, end_.shear_factors);
  d.points = mix(start_.points, end_.points);
  return d;
}

BeamSection SectionLaw::at(double s) const { return uniform_ ? *uniform_ : evaluate(between(s)); }

ElementSections SectionLaw::over(double s_A, double s_B) const {
  if (uniform_) return *uniform_;
  std::array<BeamSection, 3> sections;
  for (std::size_t g = 0; g < 3; ++g) sections[g] = at(s_A + ElementSections::place[g] * (s_B - s_A));
  return ElementSections(std::move(sections));
}

}  // namespace bielle::mechanism
