#include "mechanism/joints/actions/joint_spring.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void JointSpring::read(const YamlValue& value, bool damping, Model& model) {
  read_law(value, {"q", "v"}, damping, model, references(), law_);
}

void JointSpring::declare(Declaration& declaration) const {
  declare_references(declaration);
  declaration.damping = law_.has_damping();
  declaration.reads_reactions = law_.reads_reactions();
}

void JointSpring::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateSlopes& slopes = calc_slopes(state);
  const LawForce law = law_.calc(state, slopes.value - rest_, slopes.rate, splits());
  auto of_joint = r.segment(row(state), slopes.g().size());
  if (splits())
    of_joint += law.N_elastic * slopes.g() + (law.N - law.N_elastic) * slopes.w();
  else
    of_joint += law.N * slopes.g();
}

// dN = N_x g + N_v (v^T W dz + w dv) + measures;   d(N g) = N S + g dN; the terms along w are similar
void JointSpring::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  CoordinateDerivatives& jet = calc(state);
  const double x = jet.value - rest_, v = jet.rate;
  const LawForce law = law_.calc(state, x, v, splits());
  const int at = row(state);
  const auto n = jet.g().size();
  const double elastic = splits() ? law.N_elastic : 0, elastic_x = splits() ? law.N_elastic_x : 0;
  if (tangent.wants_K) {
    auto K = tangent.K.dense().block(at, at, n, n);
    K += (law.N - elastic) * jet.W();
    K += (law.N_x - elastic_x) * jet.w() * jet.g().transpose();
    if (law.N_v != 0) K += law.N_v * jet.w() * rate_slope(state, jet).transpose();
    if (splits()) K += elastic * jet.S() + elastic_x * jet.g() * jet.g().transpose();
  }
  if (tangent.wants_C) tangent.C.dense().block(at, at, n, n) += law.N_v * jet.w() * jet.w().transpose();
  if (law_.reads_state()) {
    const VectorX w = jet.w();  // a copy, because measures may belong to the same joint and overwrite its buffer
    law_.add_measures(state, x, v, w, at, tangent);
  }
}

void JointSpring::add_energy(const LocalState& state, Energy& energy) const {
  const auto [q, v] = value(state);
  const double x = q - rest_, N = law_.force(state, x, v);
  if (law_.is_actuator()) {
    energy.input -= N * v;
    return;
  }
  energy.elastic += law_.elastic_energy(state, x);
  energy.dissipation += (N - law_.force(state, x, 0)) * v;
}

std::vector<TimeDependent::Formula> JointSpring::time_formulas() const {
  if (!law_.holds_time()) return {};
  return {{"spring on " + coordinate().name, coordinate().force_units()}};
}

void JointSpring::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  const auto [q, v] = value(state);
  values[0] = law_.force(state, q - rest_, v);
}

void JointSpring::describe(const LocalState& /*state*/, Description& description) const {
  const bool turning = coordinate().kind != JointCoordinate::Kind::displacement;
  description.add_line(fmt::format("spring on {}: {}, free at {:.6g} {}", coordinate().name,
                                   fmt::join(law_.describe(turning), ", "), rest_, coordinate().units()));
}

std::vector<OutputField> JointSpring::output_fields() const {
  return {force_field("spring_force", "force or torque of springs and dampers in the joint along its coordinates")};
}

void JointSpring::write_output(const LocalState& state, double* values) const {
  const auto [q, v] = value(state);
  write_force(-law_.force(state, q - rest_, v), values);
}

}  // namespace bielle::mechanism
