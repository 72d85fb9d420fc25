// Bearings of a shaft: joints without constraints, whose forces follow a law of the relative motion (bearing_law.hpp).
//
// The axis z is fixed on the first node (the housing). Measures:
//     x, y    radial displacement of the second attachment point, along the housing's axes
//     z       axial displacement
//     tilt_x, tilt_y   the smallest rotation vector from the housing's z to the shaft's, along the housing's x,
//     y:
//             with the shaft's z in the housing's axes n,  tau = theta/sin(theta) [-n_y, n_x],  cos(theta) = n_z
//     angle   of the shaft about z, counted over turns
// The first five do not depend on the shaft's angle. Tilts stay below half a turn.
//
// Energies: the part of the force with a potential is elastic. The part of the force due to rates other than the speed
// of the shaft dissipates its power. The power of the rest, forces of the turning shaft and cross-coupled stiffness,
// counts as input: these drive or brake a whirl, and the law does not say which drive supplies their work.
#pragma once

#include <array>
#include <memory>

#include "mechanism/joints/flexible/bearing_law.hpp"
#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

class ShaftBearing final : public Joint {
 public:
  /// @param law  the object may be shared, because laws are const
  ShaftBearing(std::string type, std::string name, JointFrames frames, std::shared_ptr<const BearingLaw> law,
               const Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Output `force` (5): forces of the bearing on the shaft along x, y, z, tilt_x, tilt_y.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  bool reaction_has_rates() const override { return law_->has_rates(); }
  /// Checks the tilt and stores it. @throws ComputationError for nearly half a turn or more
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  /// The names are "force.x" and so on, forces on the shaft, and the measures of all joints.
  std::vector<std::string> measure_names() const override;
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;
  /// Computes one of these forces, with its derivatives over the local layout.
  double calc_force(const LocalState& state, Eigen::Index k, MeasureGradient& gradient) const;

 private:
  template <int order>
  using Measures = std::array<PairMeasureOf<order>, 6>;
  struct Motion {
    Vector6 e, v;
  };
  template <int order>
  Measures<order> calc_measures(const LocalState& state) const;
  template <class Measure>
  Motion motion(const LocalState& state, const std::array<Measure, 6>& measures) const;
  /// Returns a tilt. @param index  3 or 4
  PairMeasure calc_own_coordinate(std::size_t index, const LocalState& state) const override;
  PairSlope calc_own_slope(std::size_t index, const LocalState& state) const override;
  std::shared_ptr<const BearingLaw> law_;
};

}  // namespace bielle::mechanism
