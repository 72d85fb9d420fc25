// Coordinates of joints in fixed ratios: gears, differentials, rack and pinion.
//
//     sum_k f_k c_k = 0,   c_k a displacement, or an angle counted over turns
// Coordinates are zero as drawn. Each is relative to the first node of its joint, so that gears on moving carriers need
// nothing special: hinges of the wheels on their carrier, and the ratio of the wheels as the carrier sees it. The
// generalised force on c_k is -f_k lambda; it acts on both nodes of its joint, on the carrier as well. (What bearings
// bear of the forces between teeth: gear_mesh.hpp.)
// Reference: Geradin and Cardona (2001) ch. 7.
#pragma once

#include <string>
#include <vector>

#include "mechanism/joints/couplings/coordinate_named_by.hpp"
#include "mechanism/model/references.hpp"

namespace bielle::mechanism {

class LinearCoupling final : public Component {
 public:
  using Component::Component;
  /// One term of the sum. @param factor  not zero
  void add_term(const NamedCoordinate& coordinate, double factor);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  double turning_rate(const LocalState& state) const override;
  /// `force`: on each coordinate.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  struct Term {
    const Joint* joint;
    std::size_t coordinate;
    double factor;
    int reference;
    const JointCoordinate& description() const { return joint->coordinates()[coordinate]; }
  };
  std::vector<Term> terms_;
  References references_;
};

/// `gear: {joints: [a, b], ratio: rate of b over that of a}`, signed; or `teeth: [z_a, z_b]` of wheels that roll on
/// each other outside (`internal: true`: inside); or `factors: [f_1, ..]` of two or more coordinates.
void read_gear(const std::string& name, const YamlValue& entry, Model& model);
/// `differential: {joints: [input, left, right], ratio: rate of the input over the mean of the two}`
void read_differential(const std::string& name, const YamlValue& entry, Model& model);
/// `rack_and_pinion: {joints: [pinion, rack], radius: displacement of the rack over the angle}`
void read_rack_and_pinion(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
