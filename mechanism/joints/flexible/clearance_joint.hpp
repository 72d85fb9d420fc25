// Hinges and ball joints with clearance: forces in the gap between journal and bush.
//
//   clearance_hinge      a journal in a bush, with a radial gap; it touches the bore at either end of its length, so
//                        that its tilt is limited by the gap, and with an axial gap its collars touch the bush's
//                        ends. The angle about the axis is free
//   clearance_spherical  a ball in a socket
// There is no force as long as there is a gap. If surfaces penetrate each other by p (clearance_contact.hpp), they have
// the normal force N = k p^n (1 + d pdot) (laws/normal_law.hpp) and the friction force N mu against the sliding
// velocity (friction_law.hpp): regularised Coulomb, or bristles (bristle_step.hpp), one for each place. A bristle is
// zero at the beginning of contact, is fixed in the axes of the bush, and follows the surface of the bore. Steps end
// when contact begins and ends. With a restitution, d follows from the approach speed of each contact: it is stored
// until the contact ends.
// Memory: [of the joint | for each place: whether it touches, d, the bristle z in the joint's axes on the bush | time].
// References: P. Flores, J. Ambrosio, J. C. P. Claro, H. M. Lankarani, Kinematics and Dynamics of Multibody Systems
// with Imperfect Joints (Springer, 2008).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mechanism/joints/flexible/clearance_contact.hpp"
#include "mechanism/joints/joint.hpp"
#include "mechanism/laws/bristle_step.hpp"
#include "mechanism/laws/friction_law.hpp"
#include "mechanism/laws/normal_law.hpp"
#include "mechanism/model/open_contact.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class ClearanceJoint final : public Joint, public OpenContact {
 public:
  /// A place with its law and its name in events: "at the first end".
  struct Place {
    std::string name;
    ClearancePlace place;
    NormalLaw law;
  };
  ClearanceJoint(std::string type, std::string name, JointFrames frames, std::vector<JointCoordinate> coordinates,
                 std::vector<Place> places, std::optional<FrictionLaw> friction, const Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  /// Outputs `penetration` [m] and `normal_force` [N] of each place.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  bool reaction_has_rates() const override { return true; }
  /// Returns the names of the smallest gap of all places, negative in contact ("gap"), and of the sum of their normal
  /// forces ("normal_force"), besides the measures of all joints.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  /// Computes the gap or the normal force, with its derivatives over the local layout.
  double calc_gap(const LocalState& state, MeasureGradient& gradient) const;
  double calc_normal_force(const LocalState& state, MeasureGradient& gradient) const;
  std::string what_is_open(const LocalState& state) const override;

 private:
  PairRotation rotation(const LocalState& state) const;
  ClearanceContact contact(std::size_t k, const LocalState& state, const PairRotation& rotation, bool second) const;
  NormalLaw::Force push(std::size_t k, const LocalState& state, const ClearanceContact& contact) const;
  /// Returns the index of the first memory entry of a place: whether its surfaces touch, the present damping d, and the
  /// bristle.
  Eigen::Index memory_of(std::size_t k) const {
    constexpr std::size_t of_place = 5;
    return static_cast<Eigen::Index>(2 * coordinates().size() + of_place * k);
  }
  bool has_bristles() const { return friction_ && friction_->model == FrictionLaw::Model::lugre; }
  /// Tells whether friction acts. In statics the bristles keep their values, without sliding.
  bool rubs(const LocalState& state) const { return friction_ && !(has_bristles() && state.environment().statics); }
  /// Returns the bristle of a place over this step. @param slip  [m/s]
  BristleStep bristle(std::size_t k, const LocalState& state, const ClearanceContact& contact,
                      const Vector3& slip) const;
  Vector3 bristle_before(std::size_t k, const LocalState& state) const {
    return state.memory().segment<3>(memory_of(k) + 2);
  }
  void remember_bristles(const LocalState& state, Eigen::Ref<VectorX> memory) const;
  std::vector<Place> places_;
  std::optional<FrictionLaw> friction_;
};

const KeyTable& clearance_hinge_keys();
/// Reads `{nodes, position | at, axis, radial_gap, length, axial_gap, radius, contact, axial_contact, friction}`.
void read_clearance_hinge(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& clearance_spherical_keys();
/// Reads `{nodes, position | at, axis, radial_gap, radius, contact, friction}`.
void read_clearance_spherical(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
