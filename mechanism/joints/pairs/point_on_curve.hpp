// A point of the second node on a curve of the first; its rotation is free.
//
// The curve c(u) is fixed in J_A (math/curve.hpp). Its parameter u is an unknown of the joint, an amplitude without
// mass:
//     Phi = d - c(u) = 0,   d: the vector from J_A to J_B along the axes of J_A                 (three rows)
// The equation of u is -c' . lambda = 0: without friction the reaction is normal to the curve; with friction, which
// acts on u, its part along the curve balances the friction, and the rest is the normal force. This is valid for any
// curvature, and u distinguishes the two passages if the curve passes the same point twice. Coordinate `displacement`:
// the arc length from the initial position of the point. In the plane of J_A (a roller on a cam) there are two rows,
// and the curve can only push: an event is recorded when it would have to pull. A roller has no mass. Relative to the
// curve it rotates at displacement'/R, and its pin at the rate of the coordinate `angle`, of J_B relative to J_A about
// z. Friction on the pin resists the rotation of the roller, so that the curve drags its middle; the pin carries all of
// the reaction. A follower without a roller slides on the curve.
#pragma once

#include "mechanism/joints/joint.hpp"
#include "mechanism/math/curve.hpp"

namespace bielle::mechanism {

class PointOnCurve final : public Joint {
 public:
  enum class Guide { space, plane };
  /// @param curve  curve in J_A; for a plane guide closed, anticlockwise about z   @param start  the value of u near
  /// the initial
  ///               position of the point
  /// @param roller  radius [m] of the roller about the point of a plane guide, whose middle moves on `curve`; 0: none
  PointOnCurve(std::string type, std::string name, JointFrames frames, Curve curve, double start, Guide guide,
               const Model& model, double roller = 0);

  std::vector<SlidingSurface> sliding_surfaces() const override;
  Vector6 calc_press(const LocalState& state) const override;
  Vector6 calc_press(const LocalState& state, MatrixX& derivatives) const override;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  double turning_rate(const LocalState& state) const override;
  void calc_coordinate(std::size_t index, const LocalState& state, CoordinateDerivatives& jet) const override;
  void calc_slopes(std::size_t index, const LocalState& state, CoordinateSlopes& slopes) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

 private:
  CoordinateRate principal_coordinate(std::size_t index, const LocalState& state) const override;
  int rows() const { return guide_ == Guide::space ? 3 : 2; }
  Curve curve_;
  double start_, length_to_start_;
  Guide guide_;
  double roller_;
};

const KeyTable& point_on_curve_keys();
/// Reads `curve`: a file of three columns, initial inertial positions [m]; and `closed`.
void read_point_on_curve(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
