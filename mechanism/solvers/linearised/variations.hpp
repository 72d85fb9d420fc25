// Complex variations of a state as components and nodes see them.
#pragma once

#include <complex>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// What belongs to u exp(s t), see equations.hpp.
struct Variation {
  Eigen::VectorXcd u;           ///< (n) increments of dofs and first-order unknowns
  Eigen::VectorXcd rate;        ///< (n) variations of their rates
  Eigen::VectorXcd multiplier;  ///< of all multipliers of the system; or none
};

/// Increments [dx; dTheta] and variations of velocities [dv; dOmega] of a node, carried ones included.
struct NodeVariation {
  Eigen::Matrix<std::complex<double>, 6, 1> position, rate;
};
NodeVariation node_variation(const System& system, const State& state, const Variation& variation, int node);

/// Variations over a component's local layout, what it refers to included.
struct LocalVariation {
  Eigen::VectorXcd position, rate;
};
LocalVariation local_variation(const System& system, const State& state, const Variation& variation,
                               const Slots& slots);

}  // namespace bielle::mechanism
