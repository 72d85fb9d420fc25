// The section at a position along a beam: computed once for a uniform beam, interpolated along a taper.
#include <cmath>

#include <fmt/format.h>

#include "mechanism/elements/beam/beam_section.hpp"
#include "mechanism/elements/beam/section_outline.hpp"
#include "mechanism/math/gauss.hpp"

namespace bielle::mechanism {

double ElementSections::mean_mass() const {
  double sum = 0;
  for (std::size_t g = 0; g < 3; ++g) sum += Gauss3::weight[g] * at[g].mass;
  return sum;
}

SectionLaw::SectionLaw(const YamlValue& value) : value_(value) {
  if (!value.is_sequence()) {
    start_ = end_ = read(value);
    uniform_ = evaluate(0);
    return;
  }
  if (value.size() != 2) value.fail("expected a section or a pair [start, end]");
  start_ = read(value.at(std::size_t{0}));
  end_ = read(value.at(std::size_t{1}));
  check_taper(value, start_, end_);
  constexpr int samples = 64;  // the centroid of a tapered t or l does not move linearly
  for (int k = 0; k <= samples; ++k) check_points(between(static_cast<double>(k) / samples));
  if (is_made_of_walls(start_.kind))
    walls_.emplace(start_.kind, start_.numbers, end_.numbers, start_.points, end_.points);
}

void SectionLaw::check_points(const Definition& d) const {
  for (Eigen::Index p = 0; p < d.points.size(); p += 2)
    if (!shape_contains(d.kind, d.numbers, d.points.segment<2>(p)))
      value_.fail(
          fmt::format("stress point {} lies outside of the section somewhere between start and end", p / 2 + 1));
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

namespace {

/// Returns whether all constants of the section are finite: those of extreme lengths and moduli overflow.
bool is_representable(const BeamSection& section) {
  return section.stiffness.allFinite() && section.stiffness.diagonal().minCoeff() > 0 && std::isfinite(section.mass) &&
         section.inertia.allFinite() && (section.mass == 0 || section.inertia.diagonal().minCoeff() > 0);
}

}  // namespace

BeamSection SectionLaw::evaluate(double s) const {
  const Definition d = between(s);
  BeamSection section;
  if (d.kind == "EA") {
    section.stiffness = d.numbers.head<6>().asDiagonal();
    section.mass = d.numbers[6];
    section.inertia = d.numbers.segment<3>(7).asDiagonal();
    section = section.shifted(d.offset);
  } else if (d.kind == "stiffness") {
    section.stiffness = d.numbers.head<36>().reshaped(6, 6);
    section.set_mass(d.numbers.tail<36>().reshaped(6, 6));
    section = section.shifted(d.offset);
  } else {
    const SectionValues values =
        walls_ ? walls_->at(s) : section_values(*make_section_shape(d.kind, d.numbers), d.points);
    SectionConstants k = values.constants;
    if (d.shear_factors.size() == 2) k.shear_area = k.A * d.shear_factors.asDiagonal().toDenseMatrix();
    section = BeamSection::homogeneous(k, d.material[0], d.material[1], d.material[2], d.offset);
    section.reach = shape_reach(d.kind, d.numbers);
    section.twist_reach = shear_of_twist(d.kind, d.numbers, values.constants);
    for (std::size_t p = 0; p < values.shear_stress.size(); ++p)
      section.stress.push_back(unit_stress(values.constants, d.points.segment<2>(static_cast<Eigen::Index>(2 * p)),
                                           d.offset, values.shear_stress[p]));
  }
  if (!is_representable(section))
    value_.fail(
        "this section's stiffness or mass is too large or too small for a number; lengths are in m, moduli in "
        "Pa, densities in kg/m^3");
  return section;
}

BeamSection SectionLaw::at(double s) const { return uniform_ ? *uniform_ : evaluate(s); }

ElementSections SectionLaw::over(double s_A, double s_B) const {
  if (uniform_) return *uniform_;
  std::array<BeamSection, 3> sections;
  for (std::size_t g = 0; g < 3; ++g) sections[g] = at(s_A + Gauss3::place[g] * (s_B - s_A));
  return ElementSections(std::move(sections));
}

std::vector<DrawnSection> SectionLaw::drawn() const {
  if (start_.kind == "EA" || start_.kind == "stiffness") return {};
  // Outlines of a taper are linear, except that the centroid of i, t and l, which is on the line, does not move
  // linearly.
  const bool linear = !is_made_of_walls(start_.kind) || start_.kind == "box";
  const int stations = uniform_ || linear ? 1 : 16;
  std::vector<DrawnSection> sections;
  for (int k = 0; k <= stations; ++k) {
    const double at = static_cast<double>(k) / stations;
    const Definition d = between(at);
    sections.push_back(section_outline(d.kind, d.numbers, d.offset));
    sections.back().at = at;
  }
  return sections;
}

}  // namespace bielle::mechanism
