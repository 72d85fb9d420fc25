#include "tests/support/orifices_in_series.hpp"

#include <cmath>

namespace bielle::test {

using namespace mechanism;

namespace {

double flow(double c, double s, double s_0) { return c * s / std::pow(s * s + s_0 * s_0, 0.25); }

double flow_by_pressure(double c, double s, double s_0) {
  const double q = s * s + s_0 * s_0;
  return c * (q - s * s / 2) / std::pow(q, 1.25);
}

}  // namespace

OrificesInSeries::OrificesInSeries(std::string name, const Law& law, double pressure, double guess)
    : Component("orifices_in_series", std::move(name)), law_(law), pressure_(pressure), guess_(guess) {}

void OrificesInSeries::declare(Declaration& declaration) const {
  constexpr double scale = 1e7;
  declaration.first_order = {
      {"pressure", "Pa", pressure_, ConstraintKind::holonomic, scale, "m^3/s", false},
      {"pressure of the junction", "Pa", guess_, ConstraintKind::holonomic, scale, "m^3/s", true}};
  declaration.stiffness = declaration.damping = true;
}

void OrificesInSeries::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const double p = state.first_order()[0], y = state.first_order()[1];
  const double in = flow(law_.c_1, p - y, law_.s_0), out = flow(law_.c_2, y, law_.s_0);
  r[0] += law_.capacity * state.first_order_rate()[0] + in;
  r[1] += in - out;
}

void OrificesInSeries::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  auto K = tangent.K.dense(), C = tangent.C.dense();
  const double p = state.first_order()[0], y = state.first_order()[1];
  if (tangent.wants_K) {
    const double in = flow_by_pressure(law_.c_1, p - y, law_.s_0), out = flow_by_pressure(law_.c_2, y, law_.s_0);
    K(0, 0) += in;
    K(0, 1) -= in;
    K(1, 0) += in;
    K(1, 1) -= in + out;
  }
  if (tangent.wants_C) C(0, 0) += law_.capacity;
}

}  // namespace bielle::test
