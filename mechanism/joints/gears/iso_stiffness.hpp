// Mean stiffness of the mesh of cylindrical wheels after ISO 6336-1:2006, clause 9, method B.
//
//     q' = C_1 + C_2/z_n1 + C_3/z_n2 + C_4 x_1 + C_5 x_1/z_n1 + C_6 x_2 + C_7 x_2/z_n2 + C_8 x_1^2 + C_9 x_2^2
//     c' = C_M C_R C_B cos(beta) (E/E_steel)/q',   C_M = 0.8,   z_n = z/(cos(beta_b)^2 cos(beta)) (a ring: infinite)
//     C_B = (1 + 0.5 (1.2 - h_fP/m_n)) (1 - 0.02 (20 deg - alpha_n))
//     c_gamma = c' (0.75 eps_alpha + 0.25)
// in N/(mm um) = 1e9 N/m^2, per width of the teeth, along the line of action in the transverse plane; valid for a
// specific load of at least 100 N/mm and a transverse contact ratio eps_alpha >= 1.2. Along the normal of the teeth the
// stiffness is b c_gamma/cos(beta_b)^2, sin(beta_b) = sin(beta) cos(alpha_n), because the same deformation and force
// are inclined to the transverse plane by beta_b.
#pragma once

#include <array>

namespace bielle::mechanism {

struct CylindricalTeeth {
  double width;                    ///< common width b of the teeth [m]
  std::array<double, 2> teeth;     ///< z_1, z_2
  std::array<double, 2> shifts{};  ///< profile shift coefficients x_1, x_2
  double pressure_angle;           ///< alpha_n [rad]
  double helix;                    ///< beta [rad]
  bool ring = false;               ///< the second wheel has teeth inside
  double dedendum = 1.2;           ///< h_fP/m_n of the basic rack
  double blank = 1;                ///< C_R: 1 for solid wheels
  double young = 206e9;            ///< modulus E of elasticity [Pa]; E_steel = 206 GPa
};

/// Returns the transverse contact ratio of an external pair of tip radii r_i + m_n (1 + x_i), mounted without play,
/// from the involutes (ISO 21771).
double transverse_contact_ratio(const CylindricalTeeth& pair);

struct IsoStiffness {
  double single;  ///< c' [N/m^2]
  double mesh;    ///< c_gamma_alpha [N/m^2]
  double normal;  ///< stiffness of the mesh along the normal of the teeth [N/m]
};
IsoStiffness iso_stiffness(const CylindricalTeeth& pair, double contact_ratio);

}  // namespace bielle::mechanism
