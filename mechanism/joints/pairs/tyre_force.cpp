#include "mechanism/joints/pairs/tyre_force.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {
namespace {

/// Returns f(psi) and its derivative.
std::pair<double, double> brush(double psi) {
  if (psi < 1) return {1 - psi + psi * psi / 3, -1 + 2 * psi / 3};
  return {1 / (3 * psi), -1 / (3 * psi * psi)};
}

}  // namespace

TyreForce::TyreForce(std::string name, const WheelJoint& wheel, const TyreLaw& law)
    : Component("tyre", std::move(name)), wheel_(wheel), law_(law) {}

void TyreForce::declare(Declaration& declaration) const {
  declaration.references = {&wheel_};
  declaration.stiffness = declaration.damping = true;
  declaration.reads_reactions = declaration.kinks = law_.friction.has_value();
}

template <int order>
TyreForce::Force<order> TyreForce::calc(const LocalState& of_wheel) const {
  Force<order> force;
  force.slip = wheel_.calc_slip<order>(of_wheel);
  const Vector2 v(force.slip.longitudinal.value, force.slip.lateral.value), C(law_.longitudinal, law_.lateral);
  const double forward = force.slip.forward.value, V = std::hypot(forward, law_.speed);
  force.sigma = v / V;
  const Vector2 s = C.cwiseProduct(force.sigma);
  const Eigen::Matrix2d ds = (C / V).asDiagonal();      // derivative by v
  const Vector2 ds_forward = -s * (forward / (V * V));  // derivative by V_x
  double f = 1;
  Eigen::RowVector2d df = Eigen::RowVector2d::Zero();  // derivative by s
  double df_N = 0;
  if (law_.friction) {
    const double N = std::max(0.0, of_wheel.reaction()[0]), most = 3 * *law_.friction * N, size = s.norm();
    if (most <= 0 || size / most > 1e150) {  // the wheel has no contact
      force.F.setZero();
      force.by_v.setZero();
      force.by_forward.setZero();
      force.by_N.setZero();
      return force;
    }
    const double psi = size / most;
    const auto [value, slope] = brush(psi);
    f = value;
    if (size > 0) df = slope / (most * size) * s.transpose();
    df_N = -slope * psi / N;
  }
  force.F = -f * s;
  force.by_v = -f * ds - s * (df * ds);
  force.by_forward = -f * ds_forward - s * df.dot(ds_forward);
  force.by_N = -df_N * s;
  return force;
}

void TyreForce::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Force<1> force = calc<1>(state.of(0));
  r.segment<12>(state.slots().reference_row(0)) -=
      force.F[0] * force.slip.longitudinal.gradient + force.F[1] * force.slip.lateral.gradient;
}

void TyreForce::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  const LocalState of_wheel = state.of(0);
  const Force<2> force = calc<2>(of_wheel);
  const Vector12 v = pair_rate(of_wheel.node(0), of_wheel.node(1));
  const WheelJoint::Slip<2>& slip = force.slip;
  Eigen::Matrix<double, 2, 12> w, by_position;
  w << slip.longitudinal.gradient.transpose(), slip.lateral.gradient.transpose();
  by_position << (slip.longitudinal.second.transpose() * v).transpose(),
      (slip.lateral.second.transpose() * v).transpose();
  const int at = state.slots().reference_row(0);
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    Eigen::Matrix<double, 2, 12> dF = force.by_v * by_position;
    dF += force.by_forward * (slip.forward.second.transpose() * v).transpose();
    auto block = K.block<12, 12>(at, at);
    block -= force.F[0] * slip.longitudinal.second + force.F[1] * slip.lateral.second;
    block -= w.transpose() * dF;
    if (law_.friction) K.block<12, 1>(at, at + 12) -= w.transpose() * force.by_N;
  }
  if (tangent.wants_C) {
    Eigen::Matrix<double, 2, 12> dF = force.by_v * w;
    dF += force.by_forward * slip.forward.gradient.transpose();
    tangent.C.dense().block<12, 12>(at, at) -= w.transpose() * dF;
  }
}

void TyreForce::add_energy(const LocalState& state, Energy& energy) const {
  const Force<1> force = calc<1>(state.of(0));
  energy.dissipation -= force.F[0] * force.slip.longitudinal.value + force.F[1] * force.slip.lateral.value;
}

std::vector<OutputField> TyreForce::output_fields() const {
  return {{"slip", {2}, "-", "longitudinal and lateral slip: velocities of the contact over the forward speed"},
          {"tyre_force", {2}, "N", "on the wheel, along its way and across it"}};
}

void TyreForce::write_output(const LocalState& state, double* values) const {
  const Force<1> force = calc<1>(state.of(0));
  Eigen::Map<Eigen::Vector4d>(values) << force.sigma, force.F;
}

void TyreForce::describe(const LocalState& /*state*/, Description& description) const {
  std::string text = fmt::format("slip stiffness {:.6g} N along, {:.6g} N across", law_.longitudinal, law_.lateral);
  if (law_.friction) text += fmt::format(", friction {:.6g}", *law_.friction);
  description.add_line(text);
}

namespace {

const KeyTable& slip_keys() {
  using namespace keys;
  static const KeyTable table{
      "`slip`",
      "A tyre whose forces follow from its slip.",
      {{"longitudinal", number("N").non_negative(), required,
        "Force per longitudinal slip, the velocity of the contact over the forward speed."},
       {"lateral", number("N").non_negative(), required, "Force per lateral slip, the tangent of the slip angle."},
       {"friction", number().non_negative(), optional,
        "Coefficient of friction at which the forces saturate; without it they are linear at any slip."},
       {"speed", number("m/s").positive(), otherwise("0.1"), "Forward speed below which slip is made smooth."}}};
  return table;
}

}  // namespace

Key tyre_key() {
  using namespace keys;
  return {"slip",
          {word({"none"}, "`slip`, or {longitudinal, lateral, friction}"), nested(slip_keys)},
          otherwise("none"),
          "Slip of the wheel: `none` rolls, otherwise it is a tyre."};
}

std::optional<TyreLaw> read_tyre_law(const YamlValue& entry) {
  const YamlValue slip = entry.at("slip");
  if (slip.is_scalar()) {
    slip.word();
    return {};
  }
  TyreLaw law{slip.at("longitudinal").number(), slip.at("lateral").number(), {}, slip.at("speed").number()};
  if (const auto friction = slip.find("friction")) law.friction = friction->number();
  return law;
}

}  // namespace bielle::mechanism
