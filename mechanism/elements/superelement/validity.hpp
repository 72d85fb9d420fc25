// How far a superelement can be trusted where it is: an estimate of the error that its linear elasticity leaves.
//
// The element is exact to the third order of the deformation, so that the relative error of displacements grows with the
// square of the angle theta by which interfaces are turned relative to each other. For bars, straight and curved by up to
// 46 degrees, bent by forces until they are off by 5 to 45 % of their length, it is 0.002 to 0.0075 theta^2, and less under
// moments and twist (tests/benchmarks/superelement/test_validity.cpp). The estimate is 0.006 theta^2. It knows nothing of
// bodies whose interfaces carry forces alone, nor of the membrane forces of plates.
#pragma once

#include <optional>
#include <string>

#include "mechanism/elements/superelement/corotated_frame.hpp"
#include "mechanism/model/gatherer.hpp"

namespace bielle::mechanism {

/// Angle of an interface relative to another, the largest among those whose rotations act [rad]; 0 where there are no two.
double largest_turn(const std::vector<BodyPoint>& points, const LocalState& state);

/// The largest estimate over all steps of an analysis, and when it was reached.
class Validity final : public Gatherer {
 public:
  /// @param body    name of the element
  /// @param points  its interfaces, node k of the state being point k
  /// @param most    relative error beyond which a run fails; or none
  Validity(std::string body, const std::vector<BodyPoint>& points, std::optional<double> most)
      : body_(std::move(body)), points_(points), most_(most) {}

  void begin() override;
  /// @throws ComputationError where the estimate is beyond `most`
  void add(const LocalState& state) override;
  void exchange(Archive& archive) override;
  std::vector<ResultArray> results() override;
  std::string summary() override;
  std::string what() const override { return "validity of '" + body_ + "'"; }

 private:
  double error() const;        ///< relative
  std::string when() const;    ///< "t = 0.1 s"

  std::string body_;
  const std::vector<BodyPoint>& points_;
  std::optional<double> most_;
  double turn_ = 0, time_ = 0;
  bool statics_ = false;  ///< the time is a load factor
};

}  // namespace bielle::mechanism
