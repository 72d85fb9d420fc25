// Links without a body: two points of two nodes at a distance, with the vector d from the first to the second, |d| = L.
//
//   distance             (d . d - L^2)/(2 L) = 0: a rod with a ball at either end (`spherical_spherical`). The
//   multiplier
//                        is the tension [N]. L may be a formula of time: a rod with variable length
//   revolute_spherical   a rod with a hinge on the first node, about z of the joint's frame (`axis`), and a ball on the
//                        second: the ball also stays in its plane, z_A . d = h (initial h). Coordinate: `angle` of the
//                        rod about the hinge, from its initial position
//
// The squared form has a derivative everywhere, also at d = 0, and its gradient equals that of |d| if the row is
// satisfied.
#pragma once

#include "mechanism/joints/measured_pair.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

class DistanceJoint final : public MeasuredRows<DistanceJoint>, public TimeDependent {
 public:
  /// @param length  positive [m], as a function of t
  DistanceJoint(std::string type, std::string name, JointFrames frames, Expression length, const Model& model);
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override;
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;
  double turning_rate(const LocalState& state) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

 private:
  friend MeasuredRows;
  template <int order>
  void rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const;
  Expression length_;
};

class RevoluteSphericalLink final : public MeasuredRows<RevoluteSphericalLink> {
 public:
  /// @param length,offset  |d| and z_A . d [m]
  RevoluteSphericalLink(std::string name, JointFrames frames, double length, double offset, const Model& model);
  double turning_rate(const LocalState& state) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

 private:
  friend MeasuredRows;
  template <int order>
  void rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const;
  PairMeasure calc_own_coordinate(std::size_t index, const LocalState& state) const override;
  PairSlope calc_own_slope(std::size_t index, const LocalState& state) const override;
  double length_, offset_;
};

const KeyTable& distance_keys();
const KeyTable& spherical_spherical_keys();
const KeyTable& revolute_spherical_keys();
/// The key `at: [[..], [..]]` gives the two points in the axes of their nodes (default: the nodes). The default of
/// `length` (t) is the initial distance.
void read_distance(const std::string& name, const YamlValue& entry, Model& model);
void read_spherical_spherical(const std::string& name, const YamlValue& entry, Model& model);
/// Reads a link with the keys `at`, `length` and `axis` of the hinge.
void read_revolute_spherical(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
