// Coordinates of joints in fixed ratios: gears, differentials, rack and pinion.
//
//     sum_k f_k c_k = 0,   with displacements c_k, or angles counted over turns
// Coordinates are initially zero. Each is relative to the first node of its joint, so that gears on moving carriers are
// no special case: the wheels have hinges on their carrier, and the ratio of the wheels is that seen from the carrier.
// The generalised force on c_k is -f_k lambda; it acts on both nodes of its joint, on the carrier as well. (Forces of
// teeth on bearings: gear_mesh.hpp.) Reference: Geradin and Cardona (2001) ch. 7.
#pragma once

#include <string>
#include <vector>

#include "mechanism/joints/couplings/coordinate_named_by.hpp"
#include "mechanism/model/references.hpp"

namespace bielle::mechanism {

class LinearCoupling final : public Component {
 public:
  using Component::Component;
  /// Adds one term of the sum. @param factor  not zero
  void add_term(const NamedCoordinate& coordinate, double factor);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  double turning_rate(const LocalState& state) const override;
  /// Output `force`: generalised force on each coordinate.
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

const KeyTable& gear_keys();
const KeyTable& differential_keys();
const KeyTable& rack_and_pinion_keys();
/// Reads `gear: {joints: [a, b], ratio: rate of b over that of a}`, signed; or `teeth: [z_a, z_b]` of wheels in
/// external contact (`internal: true`: internal); or `factors: [f_1, ..]` of two or more coordinates.
void read_gear(const std::string& name, const YamlValue& entry, Model& model);
/// Reads `differential: {joints: [input, left, right], ratio: rate of the input over the mean of the two}`
void read_differential(const std::string& name, const YamlValue& entry, Model& model);
/// Reads `rack_and_pinion: {joints: [pinion, rack], radius: displacement of the rack over the angle}`
void read_rack_and_pinion(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
