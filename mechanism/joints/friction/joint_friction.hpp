// Dry friction in a joint, with a normal force from the joint's own reaction.
//
// The bodies slide on each other at a surface. Its velocity v [m/s] has one component for each of some coordinates of
// the joint: the rate of the coordinate times c, with c = 1 for displacements and the radius of the bearing for angles
// and rotations. A thread of radius r and lead l per radian slides along its helix, v = (l zdot + r^2
// thetadot)/sqrt(r^2 + l^2). A roller of radius R slides on its pin of radius r, v = r (sdot/R - thetadot), with the
// displacement s of its middle. The normal force is
//     N = |F| + |M|/arm + preload,
// with the reaction F and M of the joint's constraints. There is no reaction along free coordinates, so that F and M
// are normal to the motion. In a thread F has a fourth component M_z/r: together with F_z it gives the force normal to
// the thread. The surface resists by R = N rho(v, ..) [N], with rho from the law of friction; R acts along the same
// combination of coordinates as v. It is part of the equations of the present step, not of the previous one: N depends
// on multipliers, and its derivatives are in the tangent. If redundant constraints leave reactions undetermined, those
// of smallest norm are used.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/joints/joint.hpp"
#include "mechanism/laws/friction_law.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

struct FrictionSurface {
  /// A part of a component of v: `arm` times the rate of a coordinate.
  struct Part {
    std::size_t coordinate;
    int component;  ///< component of v
    double arm;     ///< c: dimensionless for a displacement, otherwise [m]
  };
  std::vector<Part> parts;                                      ///< at most three
  int components = 1;                                           ///< number of components of v, one to three
  double moment_arm = std::numeric_limits<double>::infinity();  ///< [m]; infinite: moments do not contribute
  double preload = 0;                                           ///< [N]
  double thread_radius = 0;                                     ///< [m]; 0: no thread
};

class JointFriction : public Component {
 public:
  JointFriction(const Joint& joint, FrictionSurface surface, const FrictionLaw& law)
      : JointFriction("friction", joint, std::move(surface), law) {}

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Outputs along the joint's coordinates: `friction`, force or torque; `normal_force`, the force N of the surface
  /// that slides along the coordinate.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;

 protected:
  JointFriction(std::string type, const Joint& joint, FrictionSurface surface, const FrictionLaw& law)
      : Component(std::move(type), joint.name()), joint_(joint), surface_(std::move(surface)), law_(law) {}
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

  /// The resistance rho and its derivatives.
  struct Resistance {
    Vector rho;
    Matrix by_v;
    Matrix by_z;  ///< by first-order unknowns of the kind of friction; empty if it has none
  };
  virtual Resistance resistance(const LocalState& state, const Vector& v) const = 0;
  /// Returns the dissipated power per unit of N, never negative [m/s]. @param resistance  at this state
  virtual double loss(const LocalState& state, const Vector& v, const Resistance& resistance) const;
  /// Returns the friction along the surface's directions that is no function of N: the force of a constraint during
  /// sticking [N].
  /// @param lambda  the component's own multipliers: those of the equations, or the reactions of smallest norm
  virtual Vector held(const LocalState::Segment& /*lambda*/) const { return Vector::Zero(size()); }

  int size() const { return surface_.components; }
  const FrictionLaw& law() const { return law_; }
  const Joint& joint() const { return joint_; }
  const FrictionSurface& surface() const { return surface_; }
  /// Returns an output field with a number for each coordinate of the joint: the value of the component of v that it
  /// contributes to, zero if the surface does not slide along it. (A joint may have several surfaces.)
  OutputField by_coordinate(const std::string& name, const std::string& units, const std::string& description) const;
  void write_by_coordinate(const Vector& by_component, double* values) const;

  /// Returns v without derivatives.
  Vector velocity(const LocalState& state) const;
  /// The normal force N.
  virtual double normal_force(const LocalState& state) const;
  /// Returns N with its derivatives over the local layout. @param gradient  zero on entry
  virtual double calc_normal_force(const LocalState& state, MeasureGradient& gradient) const;

  /// Computes v with its derivatives over the joint's layout: valid until the next call in this thread.
  struct Slip {
    Vector v;
    MatrixX w;                                  ///< (n, components): v = w^T velocities
    MatrixX by_position;                        ///< (n, components): dv = by_position^T increments; if requested
    std::array<CoordinateDerivatives, 3> jets;  ///< jets of the parts
  };
  Slip& slip(const LocalState& state, bool with_positions) const;
  /// Returns the first local row of the joint.
  static int row(const LocalState& state) { return state.slots().reference_row(0); }

 private:
  const Joint& joint_;
  FrictionSurface surface_;
  FrictionLaw law_;
};

}  // namespace bielle::mechanism
