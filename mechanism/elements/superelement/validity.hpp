// Validity of a superelement in its present state: an estimate of the error of its linear elasticity.
//
// If it is bent by its interfaces, the element is exact to the third order of the deformation, so that the relative
// error of displacements grows with the square of the angle theta by which interfaces are rotated relative to each
// other. For bars, straight and curved by up to 46 degrees, bent by forces until they are displaced by 5 to 45 % of
// their length, it is 0.002 to 0.0075 theta^2, and less under moments and twist
// (tests/benchmarks/superelement/test_validity.cpp). The estimate is 0.006 theta^2. If not all rotations of an
// interface act, its rotation is taken as one and a half times that of the line to it, which is correct for a bar under
// a force at this interface. The error of such a bar is 0.05 theta^2.
//
// If it is bent in its modes (by its own inertia, load patterns, loads at points inside), the body does not become
// shorter by bending, although it should by the square of the deformation: the error is of first order in the angle
// theta by which places of the body are rotated relative to each other. For a bar that is fixed at one end it is 0.4
// theta (under a force at its free end, which approaches the fixed end by 4/15 theta^2 L and deflects by 2/3 theta L;
// under its weight 0.43 theta). Between interfaces, whose distance does become smaller, an error of 0.03 theta remains
// (bar with clamped ends that approach each other, at its quarter points).
//
// If its mean strain is e (stretch, shear), its error is about e, because elasticity is linear (a material whose true
// stress is linear in the strain per present length differs by 1.1 e, a material that is linear in Green's strain by
// 1.5 e). Strains of 2 % anywhere give a warning too, whatever the mean is: in stout bodies, bending and twist cause
// large strains at small rotations.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mechanism/elements/superelement/body_deformation.hpp"
#include "mechanism/elements/superelement/body_strain.hpp"
#include "mechanism/elements/superelement/corotated_frame.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

/// Largest angles of interfaces relative to each other [rad].
struct BodyTurn {
  double of_interfaces = 0;  ///< interfaces whose rotations act
  /// Largest angle of the lines to interfaces whose rotations do not all act, e.g. of a bar under a force at its end.
  double of_lines = 0;
};
BodyTurn largest_turn(const std::vector<BodyPoint>& points, const LocalState& state);
/// Returns the largest rotation of a place relative to another in the modes, at the state's amplitudes [rad].
/// @param mode_turns  (3 q, amplitudes), see Superelement
double largest_turn_of_modes(const MatrixX& mode_turns, const LocalState& state);

/// Quantities from which the validity of a body is estimated, in addition to its interfaces.
struct ValidityMeasures {
  double gyration = 0;        ///< radius of gyration of the body [m]
  const MatrixX& mode_turns;  ///< as above; may be empty
  BodyStrain strain;
  std::optional<double> most;  ///< relative error beyond which a run fails; no value: no limit
};

/// Records the largest estimate over all steps of an analysis, and its time.
class Validity final : public StepRecorder {
 public:
  /// @param body         name of the element
  /// @param points       its interfaces; node k of the state is point k
  /// @param deformation  updated before each `add`
  Validity(std::string body, const std::vector<BodyPoint>& points, ValidityMeasures measures,
           std::shared_ptr<const BodyDeformation> deformation);

  void begin() override;
  /// @throws ComputationError if the estimate exceeds `most`
  void add(const LocalState& state) override;
  void exchange(Archive& archive) override;
  std::vector<ResultArray> results() override;
  std::string summary() override;
  std::string what() const override { return "validity of '" + body_ + "'"; }

 private:
  enum class Cause { bends, bends_in_modes, strains };
  static std::string when(double time, bool statics);  ///< "t = 0.1 s"
  std::string bends() const;                           ///< "bends by 0.2 rad between its interfaces"
  void note(double error, double turn, Cause cause, const LocalState& state);

  std::string body_;
  const std::vector<BodyPoint>& points_;
  ValidityMeasures measures_;
  std::shared_ptr<const BodyDeformation> deformation_;
  double error_per_mode_turn_;
  double error_ = 0, turn_ = 0, time_ = 0;
  Cause cause_ = Cause::bends;              ///< cause of the error
  double strain_ = 0, time_of_strain_ = 0;  ///< the largest anywhere
  bool statics_ = false;                    ///< times are load factors
};

}  // namespace bielle::mechanism
