// Forces on a mechanism of which a part turns (turning_part.hpp), as means over a turn.
//
// The turning part carries the component of gravity along its axis, which is constant for it. The component normal to
// the axis alternates with the azimuth: its mean over a turn is zero for the bending of the part, but its resultant
// acts on the standing node of the joint without interruption, in the plane of the part's centre of mass. The resultant
// of the inertial forces normal to the axis (of a part out of balance) turns with the part: its mean on the standing
// node is zero. Standing parts carry their whole weight.
//
// The mean state is therefore an equilibrium at every azimuth. The alternating forces and the vibrations that they
// excite are no part of it.
#pragma once

#include "mechanism/solvers/linearised/turning_part.hpp"
#include "mechanism/system/linearise.hpp"

namespace bielle::mechanism {

class MeanForces {
 public:
  /// @param part  must outlive this object; nullptr: forces as they are
  MeanForces(const System& system, const Environment& environment, const TurningPart* part);

  /// Computes the residual of all equations; drives and locks of the joint are taken to follow its rotation. @param
  /// scale  if given, receives the largest contributions
  void residual(const State& state, Eigen::Ref<VectorX> r, ResidualScale* scale = nullptr) const;
  /// @param before  see Environment::before
  SystemMatrices matrices(const State& state, const State* before = nullptr) const;

 private:
  struct Load {
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();  ///< inertial; moment about the point of the axis
  };
  Vector3 crosswise(const State& state) const;
  Load resultant(const VectorX& r, const State& state) const;
  VectorX forces_of(const Vector3& gravity, const State& still) const;
  Load mean_weight(const State& state, const State& still) const;
  void add_to_base(const Load& load, const State& state, Eigen::Ref<VectorX> r) const;

  const System& system_;
  const Environment& environment_;
  const TurningPart* part_;
  std::vector<char> turning_;
};

}  // namespace bielle::mechanism
