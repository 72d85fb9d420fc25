// Strains of beams. The law of the resultants is linear: it holds for small strains, with bending displacements of any
// size.
//
// The definitions use the strain (Gamma, Kappa) in the middle of an element, the elastic centroid o, the farthest fibre
// (b, h) from it along y and z, and the shear r per twist rate:
//     normal = |Gamma_x + kappa_y o_z - kappa_z o_y| + |(kappa_y h, kappa_z b)|,   shear = |(Gamma_y, Gamma_z)| +
//     |kappa_x| r.
// For sections given as shapes, b and h are exact, and so is r for circles, tubes and rectangles; r of other shapes is
// sqrt(2 J/A), which is too low by up to a fifth for open walls and too high by up to two fifths for closed ones.
// Sections given by constants are treated as rectangles, b = sqrt(3 EI/EA), with Poisson's ratio 0.3.
#pragma once

#include <string>

#include "mechanism/elements/beam/beam_element.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

/// The step recorder records the largest strain of a beam element over all steps, and whether its length resolves
/// bending under tension. The summary of a beam is written by the element that exceeds a bound most.
class BeamStrainWatch final : public StepRecorder {
 public:
  explicit BeamStrainWatch(const BeamElement& element) : element_(element) {}

  void begin() override;
  void add(const LocalState& state) override;
  void exchange(Archive& archive) override;
  std::vector<ResultArray> results() override { return {}; }
  std::string summary() override;
  std::string what() const override;
  std::string voice() const override;
  double loudness() const override;

 private:
  const BeamElement& element_;
  double strain_ = 0, time_ = 0;
  double layers_ = 0;     ///< BeamElement::Validity::layers
  bool statics_ = false;  ///< the time is a load factor
};

}  // namespace bielle::mechanism
