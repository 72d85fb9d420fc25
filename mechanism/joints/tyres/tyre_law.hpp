// Forces of a tyre: a radial spring and damper, and the slip of a tread whose deflection is relaxed by rolling.
//
// Normal force of a deflection e:      N = max(0, S(e) + d edot),   S(e) = k e or a curve.
// Slip velocities of the contact, with the rolling speed V_r and tau = V_r/sqrt(V_r^2 + v_0^2), its direction:
//     v'_x = v_x,   v'_y = v_y + (C_c/C_y) c tau V_r - t tau psidot:
// camber c slides the tread sideways, and the lateral force acts at the trail t behind the contact, where the turning
// of the wheel's heading, psidot, slides it as well. The tread (with the carcass) is deflected by u, along and across:
//     f = (K_x u_x, K_y u_y),   K = C/sigma                        stiffness [N/m]: slip stiffness/relaxation length
//     udot_i = v'_i - L u_i/sigma_i,        F = -(f + eta C v')/(1 + eta L) = -(f + D udot),   D = eta C/(1 + eta L)
// with the damping eta of the tread in slip, as a standing tyre has it, and the larger of two rates of decay L [m/s]:
//     rolling      |V_r| rho/(g(rho) l(N)),   rho = |C l v'|/(mu N |V_r|), but no larger than rho_c
//     sliding      (|f + eta_1 C v'|/(mu N g(rho)) - 1)/eta_1,   rho in g no smaller than rho_c
// In steady slip the force is therefore mu N g(rho) against C v': the brush model with a parabolic pressure has
//     g = rho (1 - rho/3 + rho^2/27) up to rho = rho_c = 3 (full sliding), 1 beyond,
// and the similarity method g = sin(C_s atan(X)), X = B rho - E (B rho - atan(B rho)), B = 1/C_s (magic formula), with
// its peak at rho_c. At small slip u lags behind by the rolled length sigma. A wheel that does not roll sticks below
// the friction, whatever vibrates: u follows the displacement of the contact and nothing decays. At the friction it
// slides as a plastic body does (radial return), |F| <= mu N g; if the relaxation lengths differ, |F| exceeds this by
// some thousandths while the direction of slip changes. Bristles whose decay is |C v'|/(mu N) instead, as those of the
// LuGre law, creep under a steady force as long as they vibrate (P. Dupont et al., IEEE Trans. Automatic Control 47
// (2002) 787). eta_1 = eta + T/sigma_x, T = 1 ms: the return takes a time without damping, too. eta fades as
// (1 - (V_r/v_0)^2)^2 and is zero above v_0. l(N) = 1, or 2 w/(1 + w^2) with w = N/N_0, if the slip stiffness is
// largest at the load N_0. The trail is that of the brush model, with q = |f|/(mu N) and p = (1 - q)^(1/3):
// t = 3 t_0 p^3/(1 + p + p^2). Without load the force is zero, and u vanishes at the rate 1/T. Rolling resistance is
// the moment -f N tau rho_r of the rolling radius rho_r.
//
// All forces act along the velocities that they depend on, so that the tyre dissipates
//     (S - N) edot + u . K u L/sigma + D udot . v' + f N tau V_r >= 0,      and stores  int S de + u . K u/2.
// References: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), sections 3.2 (brush model), 4.2 (similarity),
// 7.2 (relaxation), 8.6 (a tread that is damped at low speed).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/laws/force_curve.hpp"
#include "mechanism/math/types.hpp"
#include "reduce/common/autodiff.hpp"

namespace bielle::mechanism {

/// Slip of a tyre; without it the tyre has no forces along the road.
struct TyreSlip {
  Eigen::Vector2d stiffness;            ///< C_x, C_y [N]: force per slip, along and across
  Eigen::Vector2d relaxation;           ///< sigma_x, sigma_y [m]
  double friction = 0;                  ///< mu
  double damping = 0;                   ///< eta [s/m]: damping of the standing tread over its slip stiffness
  double camber = 0;                    ///< C_c [N]: lateral force per sine of the camber angle
  double trail = 0;                     ///< t_0 [m]
  std::optional<double> stiffest_load;  ///< N_0 [N]
  std::optional<double> shape;          ///< C_s of the magic formula; none: brush model
  double curvature = 0;                 ///< E
  double peak = 3;                      ///< rho_c, see `peak_of_formula`
};

/// The variables of the forces, in this order in all derivatives.
enum TyreVariable { tyre_e, tyre_c, tyre_e_rate, tyre_v_x, tyre_v_y, tyre_V_r, tyre_spin, tyre_u_x, tyre_u_y };
inline constexpr int tyre_variables = 9;
using TyreNumber = AutoDiff<tyre_variables, 1>;
using TyreValues = Eigen::Matrix<double, tyre_variables, 1>;

/// Forces with their derivatives by the variables.
struct TyreForces {
  TyreNumber N;                         ///< normal force [N]
  TyreNumber F_x, F_y;                  ///< on the wheel, along its way and across it [N]
  TyreNumber along_roll;                ///< force on the rolling speed: a moment over the rolling radius [N]
  TyreNumber moment;                    ///< aligning moment about the normal [N m]
  TyreNumber u_x_rate, u_y_rate;        ///< [m/s]
  Eigen::Vector2d slip;                 ///< v' over sqrt(V_r^2 + v_0^2)
  double elastic = 0, dissipation = 0;  ///< [J], [W]
};

/// Returns rho_c of the magic formula: its peak, or 10 if it has none before. @param C,E  shape and curvature
double peak_of_formula(double C, double E);

class SpringTyreLaw {
 public:
  double stiffness = 0;             ///< k [N/m], unless there is a curve
  std::optional<ForceCurve> curve;  ///< S
  double damping = 0;               ///< d [N s/m]
  double rolling_resistance = 0;    ///< f
  double speed = 0;                 ///< v_0 [m/s]
  std::optional<TyreSlip> slip;

  /// @param values  the variables @param touches  whether the tyre touches the road
  TyreForces calc(const TyreValues& values, bool touches) const;
  /// Describes the law in words.
  std::vector<std::string> describe() const;

 private:
  void add_slip(const std::array<TyreNumber, tyre_variables>& z, const TyreNumber& direction, TyreForces& forces) const;
  TyreNumber standing_damping(const TyreNumber& V_r) const;
};

}  // namespace bielle::mechanism
