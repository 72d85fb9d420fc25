// Forces of a ball or roller bearing: the contact of each rolling element with both rings.
//
// An element at the azimuth psi (from x about z) sees the inner ring move against the outer one, along the radius and
// along the axis, and turn about the direction of rolling, by
//     r = x cos(psi) + y sin(psi) - g/2,  s = z + z_0 + rho (tilt_x sin(psi) - tilt_y cos(psi)),
//     t = tilt_y cos(psi) - tilt_x sin(psi)
// (g: diametral clearance, z_0: axial displacement of the preload, rho: radius of the points of contact). Its
// deflection is
//     ball     delta = sqrt((A cos(alpha) + r)^2 + (A sin(alpha) + s)^2) - A,  A the distance of the groove centres:
//              the contact angle alpha grows under axial load
//     roller   delta = r cos(alpha) + s sin(alpha) + q t  at nine places q along its length,
// and its force Q = K delta^n, n = 3/2 for balls and 10/9 for rollers, if delta > 0. All of it has the potential
// sum of K delta^(n+1)/(n+1). The elements are spread evenly over the ring, or stand in a cage that turns with the
// shaft (fixed outer ring) at (1 - D cos(alpha)/d_m)/2 of its angle: the stiffness then varies as they pass. Inertia of
// the elements, friction and the elasticity of the rings are left out. Reference: T. C. Lim, R. Singh, J. Sound Vib.
// 139 (1990) 179; T. A. Harris, Rolling Bearing Analysis (4th ed., 2001), chapters 6 and 7.
#pragma once

#include "mechanism/joints/flexible/bearing_law.hpp"

namespace bielle::mechanism {

struct RollingGeometry {
  bool ball = true;
  int elements = 0;            ///< Z
  double pitch_diameter = 0;   ///< d_m [m]
  double contact_angle = 0;    ///< alpha [rad]
  double clearance = 0;        ///< g [m], diametral
  double constant = 0;         ///< K [N/m^n]
  double exponent = 1.5;       ///< n
  double groove_distance = 0;  ///< A [m], of balls
  double contact_radius = 0;   ///< rho [m]
  double roller_length = 0;    ///< [m]; 0: rollers have no tilting stiffness of their own
  bool discrete = false;       ///< elements stand in a turning cage
  double cage_angle = 0;       ///< azimuth of the first of them as drawn [rad]
  double cage_ratio = 0;       ///< turn of the cage per turn of the shaft
};

class RollingBearingLaw final : public BearingLaw {
 public:
  /// @param preload  axial force at the position as drawn [N]
  RollingBearingLaw(const RollingGeometry& geometry, double preload);
  Force calc(const Vector6& e, const Vector6& v) const override;
  Potential potential(const Vector6& e) const override;
  bool has_rates() const override { return false; }
  bool has_kinks() const override { return true; }
  std::vector<std::string> describe() const override;
  double axial_displacement() const { return z_0_; }  ///< z_0 [m]

 private:
  struct Element;
  /// Calls visit(Element) for each contact that carries a force.
  template <class Visit>
  void for_each_loaded(const Vector6& e, const Visit& visit) const;
  double displacement_of(double preload) const;
  RollingGeometry geometry_;
  double preload_, z_0_ = 0;
};

}  // namespace bielle::mechanism
