// Cross sections of beams: stiffness and mass per length in the section frame, with x along the beam, y and z normal to
// it.
//
// Resultants (n, m) = stiffness (Gamma, Kappa), in the order forces x y z, moments x y z; the origin of the section is
// the node line. A homogeneous shape (section_shape.hpp) with its centroid at o and its shear centre at o + s has
//     N = E A Gamma_c,   V = G K_s gamma_s,   T_s = G J kappa_x,
//     (M_y, M_z)_c = E [I_y -I_yz; -I_yz I_z] (kappa_y, kappa_z)
// with the strains Gamma + Kappa x o at the centroid and Gamma + Kappa x (o + s) at the shear centre, which couples all
// six. Its mass is at the centroid.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/drawing/drawn_item.hpp"
#include "mechanism/elements/beam/wall_taper.hpp"
#include "mechanism/math/types.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Section properties required by one beam element.
struct BeamSection {
  Matrix6 stiffness = Matrix6::Zero();    ///< [N, N m, N m^2], symmetric positive definite
  double mass = 0;                        ///< mass per length [kg/m]; zero: the beam has no inertia
  Vector3 mass_offset = Vector3::Zero();  ///< centre of mass from the node line [m], section frame
  Matrix3 inertia = Matrix3::Zero();      ///< inertia about the centre of mass, per length [kg m]
  Vector2 reach = Vector2::Zero();        ///< largest distance from the centroid along y and z [m]; zero: not known
  double twist_reach = 0;                 ///< largest shear strain per twist rate [m]; zero: not known
  /// At each stress point: sigma_xx, tau_xy, tau_xz [Pa] (rows) due to unit resultants (columns).
  std::vector<Eigen::Matrix<double, 3, 6>> stress;

  /// Returns a homogeneous section. @param young,shear  moduli [Pa] @param density [kg/m^3]
  /// @param offset  offset of the centroid from the node line [m]
  static BeamSection homogeneous(const SectionConstants& constants, double young, double shear, double density,
                                 const Vector2& offset = Vector2::Zero());
  /// Sets mass, offset and inertia from [[m I, -m c~], [m c~, J]], with J about the node line. @param M  matrix per
  /// length
  void set_mass(const Matrix6& M);
  /// Returns the same section with its origin at `offset` from the node line [m].
  BeamSection shifted(const Vector2& offset) const;
  /// Returns the largest strain in the section, either of a fibre along the beam or two thirds of the largest shear
  /// (beam_strain.hpp).
  /// @param strain  (Gamma, Kappa)
  double largest_strain(const Vector6& strain) const;
};

/// The sections of one element: at the three Gauss points (gauss.hpp) of its length. A single section is constant along
/// the element.
struct ElementSections {
  std::array<BeamSection, 3> at;

  ElementSections(const BeamSection& uniform) : at{uniform, uniform, uniform} {}  // NOLINT: a section is one
  explicit ElementSections(std::array<BeamSection, 3> sections) : at(std::move(sections)) {}
  const BeamSection& middle() const { return at[1]; }
  double mean_mass() const;  ///< per length [kg/m]
};

/// Section along a beam, with s in [0, 1] from start to end. A pair [start, end] is a taper that is linear in
/// dimensions and constants.
class SectionLaw {
 public:
  /// @throws InputError naming the key that is missing, unknown or out of range
  explicit SectionLaw(const YamlValue& value);
  BeamSection at(double s) const;
  ElementSections over(double s_A, double s_B) const;  ///< sections of the element from s_A to s_B
  /// Sections by which the beam is drawn, at stations along it; none if the section is given by constants.
  std::vector<DrawnSection> drawn() const;
  std::size_t stress_points() const { return static_cast<std::size_t>(start_.points.size() / 2); }

 private:
  /// One section as lists of numbers that can be interpolated.
  struct Definition {
    std::string kind;  ///< its key: "rectangle", ..., "EA", "stiffness"
    VectorX numbers;   ///< dimensions of a shape, constants, or matrices
    VectorX material;  ///< for a shape: Young's modulus, shear modulus, density
    VectorX offset;    ///< (2) offset of the centroid, or of the origin of given constants, from the node line
    bool has_density = false, has_offset = false;  ///< whether they are given
    VectorX shear_factors;                         ///< (2), or empty: values of the shape
    VectorX points;                                ///< y and z of each stress point, from the centroid
  };
  static Definition read(const YamlValue& given);
  static Definition read_shape(const std::string& kind, const YamlValue& value);
  static void check_taper(const YamlValue& value, const Definition& start, const Definition& end);
  Definition between(double s) const;
  void check_points(const Definition& definition) const;
  BeamSection evaluate(double s) const;
  YamlValue value_;  ///< the entry, for messages
  Definition start_, end_;
  std::optional<BeamSection> uniform_;  ///< set without taper
  std::optional<WallTaper> walls_;      ///< set for a taper of shapes that require finite elements
};

}  // namespace bielle::mechanism
