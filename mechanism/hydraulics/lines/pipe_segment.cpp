#include "mechanism/hydraulics/lines/pipe_segment.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Churchill's f and its slope by Re.
struct FrictionFactor {
  double f, slope;
};
FrictionFactor churchill(double Re, double relative_roughness) {
  const double a = std::pow(8 / Re, 12), w = std::pow(7 / Re, 0.9) + 0.27 * relative_roughness;
  const double theta = -2.457 * std::log(w), A = std::pow(theta, 16), B = std::pow(37530 / Re, 16);
  const double c = std::pow(A + B, -1.5), sum = a + c, f = 8 * std::pow(sum, 1. / 12);
  const double A_Re = 16 * std::pow(theta, 15) * 2.457 * 0.9 * std::pow(7 / Re, 0.9) / (Re * w);
  const double c_Re = -1.5 * c / (A + B) * (A_Re - 16 * B / Re);
  return {f, f / (12 * sum) * (c_Re - 12 * a / Re)};
}

}  // namespace

PipeLoss pipe_loss(const PipeData& pipe, double density, double viscosity, double q) {
  const double S = 0.25 * M_PI * pipe.diameter * pipe.diameter, d = pipe.diameter;
  const double Re = density * std::abs(q) * d / (S * viscosity);
  if (Re < 1) {  // f = 64/Re to rounding
    const double laminar = 32 * viscosity * pipe.length / (d * d * S);
    return {laminar * q, laminar};
  }
  const FrictionFactor factor = churchill(Re, pipe.roughness / d);
  const double k = 0.5 * density * pipe.length / (d * S * S);
  return {k * factor.f * q * std::abs(q), k * std::abs(q) * (2 * factor.f + factor.slope * Re)};
}

double inertia_factor(const Fluid& fluid, double pressure) {
  const double p = std::max(pressure, fluid.vacuum() + Fluid::atmosphere);
  return fluid.content(p).f * fluid.ratio(p).v * fluid.head(p).e_p;
}

PipeSegment::PipeSegment(std::string name, const PressureNode& from, const PressureNode& to, const PipeData& data)
    : Line("pipe", std::move(name)), data_(data) {
  const int a = add_port(from), b = add_port(to);
  add_path(a, b);
}

double PipeSegment::inertia() const {
  return data_.inertia * ports().node(0).fluid().density * data_.length /
         (0.25 * M_PI * data_.diameter * data_.diameter);
}

PipeLoss PipeSegment::loss(double q) const {
  const Fluid& fluid = ports().node(0).fluid();
  return pipe_loss(data_, fluid.density, fluid.viscosity, q);
}

void PipeSegment::declare(Declaration& declaration) const {
  Line::declare(declaration);
  declaration.damping = true;
  Declaration::Scalar flow{"flow", "m^3/s", 0};
  flow.scale = 0.25 * M_PI * data_.diameter * data_.diameter * 0.1;  // 0.1 m/s
  flow.equation_units = "Pa";
  declaration.first_order = {flow};
}

void PipeSegment::calc_flow(const LocalState& state, std::size_t /*path*/, FlowDerivatives& flow) const {
  flow.Q = state.first_order()[0];
  flow.by.position()[state.slots().first_order_row()] = 1;
}

// In a static analysis time does not advance: the flow is constant.
void PipeSegment::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  Line::add_residual(state, r);
  const int row = state.slots().first_order_row();
  r[row] += inertia() * state.first_order_rate()[0];
  if (!state.environment().statics)
    r[row] += ports().head(state, 1) - ports().head(state, 0) + loss(state.first_order()[0]).R;
}

void PipeSegment::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  Line::add_tangent(state, tangent);
  const int row = state.slots().first_order_row();
  if (tangent.wants_C) tangent.C.dense()(row, row) += inertia();
  if (!tangent.wants_K) return;
  if (state.environment().statics) {
    tangent.K.dense()(row, row) += 1;
    return;
  }
  auto K = tangent.K.dense();
  K(row, row) += loss(state.first_order()[0]).R_q;
  for (const int port : {0, 1})
    K(row, ports().pressure_row(state, port)) -=
        (port == 0 ? 1 : -1) * ports().node(port).fluid().head(ports().pressure(state, port)).e_p;
}

void PipeSegment::add_pattern(const Slots& slots, LocalPattern& pattern) const {
  Line::add_pattern(slots, pattern);
  pattern.add_block(slots.first_order_row(), 0, 1, slots.size());
}

void PipeSegment::add_energy(const LocalState& state, Energy& energy) const {
  const double q = state.first_order()[0];
  energy.kinetic += 0.5 * inertia() * q * q;
  energy.dissipation += loss(q).R * q;
}

std::string PipeSegment::describe_law() const {
  return fmt::format("pipe of {:.6g} m, diameter {:.6g} m", data_.length, data_.diameter);
}

}  // namespace bielle::mechanism
