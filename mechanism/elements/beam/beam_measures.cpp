// Forces, moments and stresses in the middle of a beam element, as measures.
#include <array>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "mechanism/elements/beam/beam_deformation.hpp"
#include "mechanism/elements/beam/beam_stress.hpp"
#include "mechanism/measures/own_measure.hpp"

namespace bielle::mechanism {
namespace {

constexpr const char* resultant_names[] = {"force.x", "force.y", "force.z", "moment.x", "moment.y", "moment.z"};

class SectionForceMeasure final : public OwnMeasure {
 public:
  SectionForceMeasure(std::string name, const BeamElement& element, int component)
      : OwnMeasure(std::move(name), element), element_(element), component_(component) {}
  std::string units() const override { return component_ < 3 ? "N" : "N m"; }

 private:
  double calc_own(const LocalState& own, MeasureGradient& gradient) const override {
    const BeamElement::MiddleForces forces = element_.calc_middle_forces(own);
    gradient.position().head<12>() = forces.by_position.row(component_).transpose();
    gradient.rate().head<12>() = forces.by_rate.row(component_).transpose();
    return forces.value[component_];
  }
  const BeamElement& element_;
  int component_;
};

/// Returns d(Ad_exp(h)^T y)/dh at h = 0.
Matrix6 transferred_gradient(const Vector6& y) {
  Matrix6 Y;
  Y << Matrix3::Zero(), skew(y.head<3>()), skew(y.head<3>()), skew(y.tail<3>());
  return Y;
}

}  // namespace

// With g = J^T f and y = A(1/2) g, A(1/2) = Ad(exp6(-d/2))^T T6^-T(d):
//   dg = df + (dq/de) t . df + (n/L) d2q/de2 dd,   dy = A dg + Ad^T G(d, g) dd - Y T6(-d/2) dd/2
BeamElement::MiddleForces BeamElement::calc_middle_forces(const LocalState& state) const {
  const Deformation D = deformation(state);
  const Vector6 g = D.of_motion(D.f, along_);
  const Matrix6 middle = wrench_to_middle(D);
  Matrix6 motion = Matrix6::Identity();  // J^T
  motion.leftCols<3>() += D.bowing.gradient * along_.transpose();
  const double n = along_.dot(D.f.head<3>());
  const Matrix6x12 P = D.PT.transpose();
  Matrix6x12 f_gradient = stiffness_ / L_ * motion.transpose() * P;
  if (damping_ > 0) f_gradient += damping_ / L_ * stiffness_ * rate_gradient(state, D);
  const Matrix6x12 g_gradient = motion * f_gradient + n / L_ * bowing_.second_gradient(D.bowing) * P;
  MiddleForces forces{middle * g, middle * g_gradient, Matrix6x12::Zero()};
  if (bending_ == BeamBending::residual) {
    const Matrix6 transfer = adjoint(exp_se3(-0.5 * D.d)).transpose() * inverse_transpose_gradient_se3(D.d, g) -
                             0.5 * transferred_gradient(forces.value) * tangent_se3(-0.5 * D.d);
    forces.by_position += transfer * P;
  }
  if (damping_ > 0) forces.by_rate = damping_ / L_ * middle * motion * stiffness_ * motion.transpose() * P;
  return forces;
}

std::vector<std::string> BeamElement::measure_names() const {
  std::vector<std::string> in_element(std::begin(resultant_names), std::end(resultant_names));
  for (std::string& each : beam_stress_names(unit_stresses().size())) in_element.push_back(std::move(each));
  std::vector<std::string> names;
  for (const std::string& each : in_element) names.push_back(fmt::format("element_{}.{}", place_.element, each));
  if (place_.elements == 1) names.insert(names.end(), in_element.begin(), in_element.end());
  if (!beam_.empty() && !unit_stresses().empty()) names.emplace_back(largest_beam_stress);
  return names;
}

std::unique_ptr<Measure> BeamElement::make_measure(const std::string& name, const std::string& measure) const {
  if (!beam_.empty() && measure == largest_beam_stress) return make_largest_stress(name, beam_);
  const std::string prefix = fmt::format("element_{}.", place_.element);
  const std::string in_element = measure.starts_with(prefix) ? measure.substr(prefix.size()) : measure;
  for (int k = 0; k < 6; ++k)
    if (in_element == resultant_names[k]) return std::make_unique<SectionForceMeasure>(name, *this, k);
  if (auto stress = make_beam_stress(name, *this, in_element)) return stress;
  return Component::make_measure(name, measure);
}

}  // namespace bielle::mechanism
