// Cross sections of beams: stiffness and mass per length in the section frame, x along the beam, y and z across.
//
// Resultants (n, m) = stiffness (Gamma, Kappa), in the order forces x y z, moments x y z; the origin of the section is
// the node line. Constants of shapes:
//   rectangle b (along y) x h (along z): torsion constant by the series of Saint-Venant's problem
//       J = a c^3 [1/3 - 64/pi^5 (c/a) sum_{n odd} tanh(n pi a/(2c))/n^5],  a >= c its sides
//     (S. Timoshenko, J. Goodier, Theory of Elasticity, art. 109); shear factors 5/6;
//   circle and tube, m = inner/outer radius: polar moment; shear factor 6 (1+m^2)^2/(7+34 m^2+7 m^4), 6/7 for a full
//   circle.
// The shear factors are those of Saint-Venant's flexure without lateral contraction (G. Cowper, J. Appl. Mech. 33
// (1966) 335, with nu = 0), so that they do not depend on the material; an input file may give others.
#pragma once

#include "mechanism/math/types.hpp"
#include "reduce/common/yaml_file.hpp"

namespace bielle::mechanism {

/// Geometric constants of a cross section about its centroid, on principal axes y and z.
struct SectionConstants {
  double A = 0;             ///< area [m^2]
  double I_y = 0, I_z = 0;  ///< second moments of area about y: integral of z^2, and about z [m^4]
  double J = 0;             ///< torsion constant [m^4]
  double k_y = 1, k_z = 1;  ///< shear factors for forces along y and z
};

SectionConstants rectangle_constants(double width_y, double height_z);
SectionConstants tube_constants(double outer_radius, double inner_radius);  ///< inner radius 0: a circle

/// What one beam element needs to know of its section.
struct BeamSection {
  Matrix6 stiffness = Matrix6::Zero();    ///< [N, N m, N m^2], symmetric positive definite
  double mass = 0;                        ///< per length [kg/m]; zero: the beam has no inertia
  Vector3 mass_offset = Vector3::Zero();  ///< centre of mass from the node line [m], section frame
  Matrix3 inertia = Matrix3::Zero();      ///< about the centre of mass, per length [kg m]

  /// A homogeneous section. @param young,shear  moduli [Pa] @param density [kg/m^3]
  /// @param offset_y,offset_z  of the centroid from the node line [m]
  static BeamSection homogeneous(const SectionConstants& constants, double young, double shear, double density,
                                 double offset_y = 0, double offset_z = 0);
};

/// Section along a beam: s in [0, 1] from start to end. A pair [start, end] tapers linearly in its dimensions and
/// constants.
class SectionLaw {
 public:
  /// @throws InputError naming the key that is missing, unknown or out of range
  explicit SectionLaw(const YamlValue& value);
  BeamSection at(double s) const;

 private:
  /// One section as a list of numbers that may be interpolated.
  struct Definition {
    std::string kind;  ///< the key that names it: "rectangle", ..., "EA", "stiffness"
    VectorX numbers;
  };
  static Definition read(const YamlValue& value);
  static BeamSection evaluate(const std::string& kind, const VectorX& numbers);
  Definition start_, end_;
};

}  // namespace bielle::mechanism
