// How far beams are strained: their law of resultants is linear, for small strains, however far they bend.
//
// With the strain (Gamma, Kappa) in the middle of an element, o the elastic centroid, (b, h) the farthest fibre from it
// along y and z and r the shear per twist:
//     normal = |Gamma_x + kappa_y o_z - kappa_z o_y| + |(kappa_y h, kappa_z b)|,   shear = |(Gamma_y, Gamma_z)| +
//     |kappa_x| r.
// For sections given as shapes b and h are exact, and so is r for circles, tubes and rectangles; r of other shapes is
// sqrt(2 J/A), which is low by up to a fifth for open walls and high by up to two fifths for closed ones. Sections
// given by constants are taken as rectangles, b = sqrt(3 EI/EA), of Poisson's ratio 0.3.
#pragma once

#include <string>

#include "mechanism/elements/beam/beam_element.hpp"
#include "mechanism/model/step_recorder.hpp"

namespace bielle::mechanism {

/// The watch keeps the largest strain of a beam element over all steps, and whether its length resolves bending under
/// tension. The element that is farthest beyond a bound speaks for its beam.
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
