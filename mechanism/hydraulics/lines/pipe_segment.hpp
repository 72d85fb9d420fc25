// A length of pipe whose fluid has inertia: one flow q, driven by the difference of the heads at its ends.
//
//     m (rho L/S) qdot = e_a - e_b - R(q),     S = pi d^2/4
//     R = f(Re) (L/d) (rho/2) w |w|,         w = q/S,  Re = rho |w| d/mu
// with S. W. Churchill's friction factor for all regimes (Friction-factor equation spans all fluid-flow regimes,
// Chemical Engineering 84 (1977) 91-92):
//     f = 8 ((8/Re)^12 + (A + B)^(-3/2))^(1/12),  A = (2.457 ln 1/((7/Re)^0.9 + 0.27 k/d))^16,  B = (37530/Re)^16.
// Segments between volumes of fluid form a pipe. Near a pressure p a cell of the volume V follows
//     pdot = B_eff f v (q_in - q_out)/V     (f the factor of the balance, Fluid::content)
// and heads differ by e' dp, so that waves travel at sqrt(B_eff f v e'/(m rho)). With the constant
//     m = f v e'     at the start pressure of the pipe
// (1 except for p/B) this is sqrt(B_eff/rho) there, and a sudden change dw of the velocity gives Joukowsky's rho c dw,
// for both conserved quantities. At other pressures both have a relative error of half of the change of p/B if volumes
// are conserved, and of the whole change if mass is.
#pragma once

#include "mechanism/hydraulics/lines/line.hpp"

namespace bielle::mechanism {

struct PipeData {
  double length, diameter;  ///< [m]
  double roughness = 0;     ///< k [m]
  double inertia = 1;       ///< m
};

/// Pressure loss R(q) [Pa] with its derivative [Pa s/m^3].
struct PipeLoss {
  double R, R_q;
};
/// Returns the factor m of a pipe with a start pressure [Pa]; for a cavity, that at atmospheric pressure.
double inertia_factor(const Fluid& fluid, double pressure);
PipeLoss pipe_loss(const PipeData& pipe, double density, double viscosity, double q);

class PipeSegment final : public Line {
 public:
  PipeSegment(std::string name, const PressureNode& from, const PressureNode& to, const PipeData& data);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const override;

 private:
  double inertia() const;
  PipeLoss loss(double q) const;
  std::string describe_law() const override;
  PipeData data_;
};

}  // namespace bielle::mechanism
