// A superelement alone: its state, residual, tangent and energy.
#pragma once

#include <memory>

#include "mechanism/elements/superelement/superelement_body.hpp"
#include "tests/support/beam_superelement.hpp"
#include "tests/support/random.hpp"

namespace bielle::test {

class SuperelementAlone {
 public:
  /// @param reference_rotations  node axes -> body axes of each interface; identities when empty
  explicit SuperelementAlone(const Superelement& superelement, std::vector<mechanism::Matrix3> reference_rotations = {},
                             std::vector<mechanism::SuperelementPlacement::Load> loads = {},
                             mechanism::BodyFrame frame = mechanism::BodyFrame::mean);

  const mechanism::SuperelementBody& body() const { return *body_; }
  int nodes() const { return static_cast<int>(slots_.nodes.size()); }
  int size() const { return slots_.size(); }  ///< number of unknowns z: 6 per node, then amplitudes
  mechanism::Environment environment;

  /// Returns the undeformed body placed at `frame` and moving rigidly: v of the frame's origin [inertial], Om [body
  /// axes], with constant v and Om.
  mechanism::State rigid_state(const mechanism::Frame& frame, const mechanism::Vector3& v = mechanism::Vector3::Zero(),
                               const mechanism::Vector3& Om = mechanism::Vector3::Zero()) const;
  /// Returns a state anywhere in space, deformed by translations and rotations up to `deformation`, with rates and
  /// accelerations of order `rate`.
  mechanism::State random_state(Random& random, double deformation, double rate) const;

  /// Returns `state` with positions moved by z and rates and accelerations changed.
  mechanism::State moved(const mechanism::State& state, const Eigen::VectorXd& z) const;
  mechanism::State with_rates(const mechanism::State& state, const Eigen::VectorXd& v, const Eigen::VectorXd& a) const;
  Eigen::VectorXd velocity(const mechanism::State& state) const;
  Eigen::VectorXd acceleration(const mechanism::State& state) const;

  Eigen::VectorXd residual(const mechanism::State& state) const;
  struct Tangent {
    Eigen::MatrixXd K, C, M;
  };
  Tangent tangent(const mechanism::State& state) const;
  mechanism::Energy energy(const mechanism::State& state) const;
  Eigen::VectorXd output(const mechanism::State& state) const;
  mechanism::CorotatedGeometry geometry(const mechanism::State& state) const;
  /// Returns the body's linear coordinates at a state, in the layout of its matrices.
  Eigen::VectorXd coordinates(const mechanism::State& state) const;
  mechanism::LocalState local(const mechanism::State& state) const { return {state, slots_, environment}; }

 private:
  std::unique_ptr<mechanism::SuperelementBody> body_;
  mechanism::Slots slots_;
};

}  // namespace bielle::test
