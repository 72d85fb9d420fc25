// Cams and their followers.
//
//   roller   the centre of a roller of the follower's node moves on the pitch curve of the contour: PointOnCurve in the
//            plane of the cam
//   flat     a flat face of the follower touches the contour: m . (p_F - x_A) - H(psi) = 0, m the direction from the
//            cam towards the face, p_F a point of the face, psi the angle of m in the cam's frame. The face slides on
//            the contour at sdot = t . (p_F - x_A)' + H psidot, t = z x m
//   lift     the follower's coordinate is a periodic function of the camshaft's angle, c_2 = f(c_1)
// The contour and f are fixed on the second node of the camshaft's joint, about its axis (z of its frame), with angles
// from the initial x of the frame. Contact forces load the bearings of roller and flat followers. Contact can only
// push: an event is recorded when it would have to pull ("lifts off").
#pragma once

#include "mechanism/joints/couplings/coordinate_named_by.hpp"
#include "mechanism/joints/measured_pair.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/formula/interpolation.hpp"

namespace bielle::mechanism {

class FlatFollower final : public MeasuredRows<FlatFollower> {
 public:
  /// @param frames  J_A: on the cam; J_B: origin on the face, z from the face away from the cam, y along the cam's axis
  FlatFollower(std::string name, JointFrames frames, Interpolation support, const Model& model);
  void declare(Declaration& declaration) const override;
  /// Returns the surface of the contact, which slides along `displacement`.
  std::vector<SlidingSurface> sliding_surfaces() const override { return {{{slide}}}; }
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;

 private:
  /// psi, counted over turns, and s, both initially zero.
  enum Coordinate : std::size_t { turn, slide };
  friend MeasuredRows;
  template <int order>
  void rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const;
  PairMeasure calc_own_coordinate(std::size_t index, const LocalState& state) const override;
  /// psi relative to its initial value, in (-pi, pi].
  template <int order>
  PairMeasureOf<order> calc_turn(const LocalState& state) const;
  /// x_A - p_F along an axis of J_B.
  template <int order>
  PairMeasureOf<order> calc_way_to_cam(int axis, const LocalState& state) const;
  Interpolation support_;
  double psi_drawn_, s_drawn_;
};

class LiftedCoordinate final : public Component {
 public:
  LiftedCoordinate(std::string name, const NamedCoordinate& angle, const NamedCoordinate& lifted, Interpolation lift);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  /// Output `force`: force of the cam on the follower's coordinate.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  struct Derivatives;
  NamedCoordinate angle_, lifted_;
  Interpolation lift_;
  References references_;
  int of_angle_, of_lifted_;
};

const KeyTable& cam_keys();
/// Reads `cam: {joints: [camshaft, follower], profile, follower: roller | flat, radius, at, normal, friction}` or `cam:
/// {joints: [camshaft, follower], lift}`
void read_cam(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
