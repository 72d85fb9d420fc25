#include "mechanism/elements/beam/beam_stress.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "mechanism/measures/own_measure.hpp"

namespace bielle::mechanism {
namespace {

using UnitStress = Eigen::Matrix<double, 3, 6>;
using ByForces = Eigen::Matrix<double, 1, 6>;  ///< derivatives by the resultants [Pa/N, Pa/(N m)]

constexpr std::array<const char*, 3> component_names{"xx", "xy", "xz"};

ByForces von_mises_gradient(const UnitStress& unit, const Vector6& f) {
  const Vector3 sigma = unit * f;
  const double stress = von_mises_stress(sigma);
  if (stress == 0) return ByForces::Zero();
  return Vector3(sigma[0], 3 * sigma[1], 3 * sigma[2]).transpose() / stress * unit;
}

/// "stress.p1.xx"
class BeamStressComponent final : public OwnMeasure {
 public:
  BeamStressComponent(std::string name, const BeamElement& element, ByForces by_forces)
      : OwnMeasure(std::move(name), element), element_(element), by_forces_(std::move(by_forces)) {}
  std::string units() const override { return "Pa"; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    const BeamElement::MiddleForces forces = element_.calc_middle_forces(own);
    gradient.position().head<12>() = (by_forces_ * forces.by_position).transpose();
    gradient.rate().head<12>() = (by_forces_ * forces.by_rate).transpose();
    return by_forces_ * forces.value;
  }
  const BeamElement& element_;
  ByForces by_forces_;
};

/// "von_mises.p1"
class BeamVonMises final : public OwnMeasure {
 public:
  BeamVonMises(std::string name, const BeamElement& element, const UnitStress& unit)
      : OwnMeasure(std::move(name), element), element_(element), unit_(unit) {}
  std::string units() const override { return "Pa"; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    const BeamElement::MiddleForces forces = element_.calc_middle_forces(own);
    const ByForces by_forces = von_mises_gradient(unit_, forces.value);
    gradient.position().head<12>() = (by_forces * forces.by_position).transpose();
    gradient.rate().head<12>() = (by_forces * forces.by_rate).transpose();
    return von_mises_stress(unit_ * forces.value);
  }
  const BeamElement& element_;
  UnitStress unit_;
};

/// "von_mises.max": at any time the derivatives are those of the element and point with the largest stress.
class LargestBeamStress final : public Measure {
 public:
  LargestBeamStress(std::string name, std::vector<const BeamElement*> elements)
      : Measure(std::move(name)), elements_(std::move(elements)) {}
  std::string units() const override { return "Pa"; }
  double value(const LocalState& state) const override { return find_largest(state).stress; }

  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    const Largest largest = find_largest(state);
    const int k = static_cast<int>(largest.element), row = state.slots().reference_row(k);
    const BeamElement& element = *elements_[largest.element];
    const BeamElement::MiddleForces forces = element.calc_middle_forces(state.of(k));
    const ByForces by_forces = von_mises_gradient(element.unit_stresses()[largest.point], forces.value);
    gradient.position().segment<12>(row) = (by_forces * forces.by_position).transpose();
    gradient.rate().segment<12>(row) = (by_forces * forces.by_rate).transpose();
    return largest.stress;
  }

 private:
  struct Largest {
    double stress = -1;  ///< [Pa]
    std::size_t element = 0, point = 0;
  };
  Largest find_largest(const LocalState& state) const {
    Largest largest;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      const Vector6 f = elements_[k]->middle_forces(state.of(static_cast<int>(k)));
      const auto& units = elements_[k]->unit_stresses();
      for (std::size_t p = 0; p < units.size(); ++p)
        if (const double stress = von_mises_stress(units[p] * f); !(stress <= largest.stress)) largest = {stress, k, p};
    }
    return largest;
  }
  void declare_subjects(Declaration& declaration) const override {
    declaration.references.assign(elements_.begin(), elements_.end());
  }
  std::vector<const BeamElement*> elements_;
};

}  // namespace

std::vector<std::string> beam_stress_names(std::size_t points) {
  std::vector<std::string> names;
  for (std::size_t p = 1; p <= points; ++p) {
    for (const char* component : component_names) names.push_back(fmt::format("stress.p{}.{}", p, component));
    names.push_back(fmt::format("von_mises.p{}", p));
  }
  if (points > 0) names.emplace_back(largest_beam_stress);
  return names;
}

std::unique_ptr<Measure> make_beam_stress(const std::string& name, const BeamElement& element,
                                          const std::string& measure) {
  const auto& units = element.unit_stresses();
  if (measure == largest_beam_stress && !units.empty()) return make_largest_stress(name, {&element});
  for (std::size_t p = 0; p < units.size(); ++p) {
    if (measure == fmt::format("von_mises.p{}", p + 1)) return std::make_unique<BeamVonMises>(name, element, units[p]);
    for (std::size_t k = 0; k < component_names.size(); ++k)
      if (measure == fmt::format("stress.p{}.{}", p + 1, component_names[k]))
        return std::make_unique<BeamStressComponent>(name, element, units[p].row(static_cast<Eigen::Index>(k)));
  }
  return nullptr;
}

std::unique_ptr<Measure> make_largest_stress(const std::string& name, std::vector<const BeamElement*> elements) {
  return std::make_unique<LargestBeamStress>(name, std::move(elements));
}

}  // namespace bielle::mechanism
