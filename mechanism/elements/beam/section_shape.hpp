// Shapes of cross sections: constants, and shear stresses due to unit resultants.
//
// clang-format off
//   rectangle b (along y) x h (along z): torsion by the series of Saint-Venant's problem
//       J = a c^3 [1/3 - 64/pi^5 (c/a) sum_{n odd} tanh(n pi a/(2c))/n^5],  a >= c its sides
//     (S. Timoshenko, J. Goodier, Theory of Elasticity, art. 109); shear factors 5/6, parabolic shear stress;
//   circle and tube, m = inner/outer radius: polar moment; shear factor 6 (1+m^2)^2/(7+34 m^2+7 m^4), 6/7 for a full
//     circle; shear stress grad [(a r^3 + b r + c/r) cos phi];
//   i, t, l, box: walls of any thickness with sharp corners, by finite elements (saint_venant.hpp; 2e-4). Fillets are
//     not included: they increase J of rolled sections by some 20 to 40 %.
// clang-format on
// Shear is that of Saint-Venant's flexure with Poisson's ratio 0 (for the symmetric shapes G. Cowper's factors, J.
// Appl. Mech. 33 (1966) 335), so that it does not depend on the material. Torsion is free: restrained warping, which is
// significant for thin open sections near clamped ends, is not modelled.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/elements/beam/saint_venant.hpp"
#include "mechanism/math/types.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// (tau_xy, tau_xz) (rows) due to unit V_y, V_z through the shear centre [1/m^2] and a unit torque [1/m^3] (columns).
using UnitShearStress = Eigen::Matrix<double, 2, 3>;

/// Geometric constants of a cross section. The coordinates y and z are from its centroid.
struct SectionConstants {
  double A = 0;                            ///< area [m^2]
  double I_y = 0, I_z = 0, I_yz = 0;       ///< integrals of z^2, y^2 and y z [m^4]
  double J = 0;                            ///< torsion constant [m^4]
  Matrix2 shear_area = Matrix2::Zero();    ///< [m^2]: (V_y, V_z) = G shear_area (gamma_y, gamma_z)
  Vector2 shear_centre = Vector2::Zero();  ///< position [m]
};

/// Returns stresses sigma_xx, tau_xy, tau_xz [Pa] (rows) per unit resultant (n, m) about the node line (columns).
/// @param point   relative to the centroid [m]
/// @param offset  offset of the centroid from the node line [m]
/// @param shear   shear stress at the point
Eigen::Matrix<double, 3, 6> unit_stress(const SectionConstants& constants, const Vector2& point, const Vector2& offset,
                                        const UnitShearStress& shear);

SectionConstants rectangle_constants(double width_y, double height_z);
SectionConstants tube_constants(double outer_radius, double inner_radius);  ///< inner radius 0: a circle

/// A shape of given size.
class SectionShape {
 public:
  virtual ~SectionShape() = default;
  const SectionConstants& constants() const { return constants_; }
  virtual bool contains(const Vector2& point) const = 0;  ///< point relative to the centroid [m], boundary included
  virtual UnitShearStress shear_stress(const Vector2& point) const = 0;

 protected:
  explicit SectionShape(const SectionConstants& constants) : constants_(constants) {}

 private:
  SectionConstants constants_;
};

/// Returns the keys of an input file that name shapes: rectangle, circle, tube, i, t, l, box.
const std::vector<std::string>& section_shape_names();
/// Reads the dimensions of a shape, a list that can be interpolated. @throws InputError
VectorX read_shape_dimensions(const std::string& shape, const YamlValue& value);
std::unique_ptr<SectionShape> make_section_shape(const std::string& shape, const VectorX& dimensions);

/// Tells whether a point relative to the centroid [m] is in a shape, boundary included. The check is cheap.
bool shape_contains(const std::string& shape, const VectorX& dimensions, const Vector2& point);

/// Returns the largest distance of a point of a shape from its centroid along y and along z [m].
Vector2 shape_reach(const std::string& shape, const VectorX& dimensions);
/// Returns the largest shear strain due to a unit twist rate [m]: for shapes made of walls about sqrt(2 J/A).
double shear_of_twist(const std::string& shape, const VectorX& dimensions, const SectionConstants& constants);

/// Tells whether a shape is i, t, l or box; these consist of rectangles, and are computed by finite elements.
bool is_made_of_walls(const std::string& shape);
RectangleArea wall_area(const std::string& shape, const VectorX& dimensions);
SectionConstants wall_constants(const RectangleArea& area, const SaintVenant& solution);

}  // namespace bielle::mechanism
