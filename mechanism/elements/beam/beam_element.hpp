// One geometrically exact beam element: two nodes, a helix between them.
//
// Section frames H_A, H_B are fixed on nodes A and B. With d = log6(H_A^-1 H_B) = [u; psi], its stress-free value d0
// and the length L (|d0_u| for a helix), the interpolation H(s) = H_A exp6(s d/L) has the constant strain [Gamma;
// Kappa] = e = (d - d0)/L; eps equals e except for the stretch by bending, see below. Then
//     dd = P [dh_A; dh_B],   P = [-T6^-1(-d), T6^-1(d)]     (dh body increments of the section frames)
//     deps = J de,   V = (L/2) eps^T C_e eps,   f = C_e eps + C_d epsdot,   epsdot = J P v/L,   forces P^T J^T f
// The element is objective, path-independent, free of locking, and exact for constant strain. Reference: V. Sonneville,
// A. Cardona, O. Bruls, CMAME 268 (2014) 451.
//
// Residual flexibility (default). Constant strain alone is too stiff in bending with shear (25 % in the tip deflection
// of a cantilever of one element), and if the axis is curved or twisted. The additional flexibility due to the
// variation of the resultants along the element is included in the section. In equilibrium without loads the wrench at
// B, T6^-T(d) f, is transferred along the element as
//     f(z) = A(z) f,   A(z) = Ad(exp6((z-1) d))^T T6^-T(d),   z from 0 at A to 1 at B,
// which at the reference state gives the element its complementary energy:
//     C_e^-1 = int_0^1 A^T C^-1 A dz  at d0   (a tapered C^-1 is the parabola through three Gauss points).
// If the line of the beam is no helix (a twisted arc), its own frames replace exp6((z-1) d0). The linear stiffness is
// then exact for any 6x6 C, for straight, curved, twisted beams or combinations; that of a tapered element converges
// with the sixth power of its length. A uniform straight element has the well-known
//     C_e^-1 = C^-1 + L^2/12 diag(t~^T S t~, 0),   t = d0_u/L,   S the lower right 3x3 of C^-1
// (R. MacNeal, Comput. Struct. 8 (1978) 175). The physical resultants in the middle are A(1/2) J^T f, at the present d,
// and the physical strain there is C^-1 A(1/2) J^T f: these are recorded as results. (Without residual flexibility,
// `bending: constant`: C_e is the mean of C; eps and f themselves are the strain and the resultants.)
//
// Stretch by bending: q(e) of beam_bowing.hpp, along the chord t = d0_u/L,
//     eps = e + t q,   J = 1 + t (dq/de)^T.
//
// Limits: the relative rotation of the ends of one element must be less than 180 degrees (`largest_turn` at the end of
// a step); an error advises to refine. The relative rotation over several elements may be larger. Strains must be small
// enough for a linear law of the resultants.
#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/elements/beam/beam_bowing.hpp"
#include "mechanism/elements/beam/beam_inertia.hpp"
#include "mechanism/elements/beam/beam_section.hpp"
#include "mechanism/math/se3.hpp"
#include "mechanism/model/component.hpp"
#include "mechanism/model/slender_component.hpp"

namespace bielle::mechanism {

/// Variation of strains along an element; see the head of this file.
enum class BeamBending { residual, constant };

/// Position of an element in its beam; for messages.
struct BeamPlace {
  int element = 1;   ///< number of the element, from 1
  int elements = 1;  ///< number of elements of the beam
};

class BeamElement : public Component, public SlenderComponent {
 public:
  /// Rotation [rad] between the ends above which a converged step is rejected: the logarithm is unique only below pi.
  static constexpr double largest_turn = 0.95 * std::numbers::pi;

  /// @param node_a,node_b  nodes of the element
  /// @param R_A,R_B        section frames in the axes of the nodes (constant)
  /// @param reference      stress-free shape
  /// @param damping        Kelvin-Voigt time constant [s]: C_d = damping * C_e
  BeamElement(std::string name, BeamPlace place, int node_a, int node_b, const Matrix3& R_A, const Matrix3& R_B,
              const BeamReference& reference, const ElementSections& sections, double damping, BeamBending bending);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Outputs `strain` (6) [Gamma; Kappa] and `resultants` (6) [n; m] in the middle of the element, section frame; with
  /// stress points also `stress` (points, 3) and `von_mises` (points).
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  /// Describes length and mass of the beam, and its sections.
  void describe(const LocalState& state, Description& description) const override;
  /// Names of the forces and moments in the middle, "element_3.force.x", and of the stresses at the stress points,
  /// "element_3.von_mises.p1"; in a beam of one element also "force.x". The first element of several also has
  /// "von_mises.max", of all.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  /// Resultants in the middle, in section axes, as recorded: forces [N], moments [N m]; with their derivatives by
  /// positions and by velocities of the two nodes.
  struct MiddleForces {
    Vector6 value;
    Eigen::Matrix<double, 6, 12> by_position, by_rate;
  };
  MiddleForces calc_middle_forces(const LocalState& state) const;
  Vector6 middle_forces(const LocalState& state) const;  ///< their values alone
  /// At each stress point: sigma_xx, tau_xy, tau_xz [Pa] (rows) per unit resultant in the middle (columns).
  const std::vector<Eigen::Matrix<double, 3, 6>>& unit_stresses() const { return section_.stress; }
  /// Gives the first element the others of its beam. @param all  from start to end, this one included
  void set_beam(std::vector<const BeamElement*> all) { beam_ = std::move(all); }
  StrainEnergies strain_energies(const LocalState& state, const Eigen::Ref<const VectorX>& du) const override;
  int softer_axis() const override;
  /// Stores psi; within the next step the relative rotation must not pass 180 degrees from this value. @throws
  /// ComputationError beyond `largest_turn`
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;

  const BeamPlace& place() const { return place_; }
  double length() const { return L_; }                               ///< [m]
  double mass() const { return mass_; }                              ///< [kg]
  const Matrix6& section() const { return section_.stiffness; }      ///< stiffness of the section in the middle
  bool knows_its_shape() const { return !section_.reach.isZero(); }  ///< false if the section is given by constants
  /// Validity of the linear law and of the element length.
  struct Validity {
    double strain;  ///< largest strain in the middle, see beam_strain.hpp; first order in the element's own bending
    double layers;  ///< L/l: bending decays within l = sqrt(EI/N) from an end under the tension N (0 without tension);
                    ///< EI is that of the softer direction
  };
  Validity validity(const LocalState& state) const;
  std::unique_ptr<StepRecorder> make_step_recorder() const override;

 private:
  struct Strain;
  struct Deformation;
  Strain strain(const LocalState& state) const;
  Deformation deformation(const LocalState& state, const Strain& strain) const;
  Deformation deformation(const LocalState& state) const;
  /// Maps J^T f to the physical resultants in the middle; an element of constant strain has one set of resultants only.
  Matrix6 wrench_to_middle(const Deformation& D) const;
  /// Returns J^T A J of a symmetric matrix A.
  Matrix6 form_of_motion(const Matrix6& A, const Strain& strain) const;
  /// Returns L depsdot by positions of the nodes.
  Eigen::Matrix<double, 6, 12> rate_gradient(const LocalState& state, const Deformation& D) const;
  /// Returns d at a state. @throws ComputationError if the relative rotation of the ends has passed 180 degrees since
  /// the last accepted step
  Vector6 relative_motion(const LocalState& state, const Matrix3& R_A, const Matrix3& R_B) const;
  [[noreturn]] void refuse(const LocalState& state, const std::string& why, const char* or_else) const;
  /// Returns the resultants that a linear step from one state to another predicts. See Environment::before.
  Vector6 predicted_resultants(const LocalState& before, const LocalState& state) const;
  void add_stiffness(const LocalState& state, const Deformation& D, Eigen::Ref<MatrixX> K) const;

  BeamPlace place_;
  std::vector<const BeamElement*> beam_;  ///< set for the first element of several
  int node_a_, node_b_;
  Matrix3 R_A_, R_B_;
  Vector6 d0_;
  double L_;
  Vector3 along_;  ///< chord direction t
  BeamBending bending_;
  Matrix6 stiffness_;                        ///< C_e
  BeamSection section_;                      ///< section in the middle
  Matrix6 flexibility_;                      ///< C^-1 in the middle
  Matrix6 to_middle_ = Matrix6::Identity();  ///< maps e to the strain in the middle, at the reference state
  double softness_;                          ///< 1/EI of the softer direction
  BeamBowing bowing_;
  double mass_;  ///< [kg]
  double damping_;
  BeamInertia inertia_;
};

}  // namespace bielle::mechanism
