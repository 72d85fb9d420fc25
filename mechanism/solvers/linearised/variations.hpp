// Complex variations of a state as seen by components and nodes.
#pragma once

#include <complex>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Variation due to u exp(s t), see equations.hpp.
struct Variation {
  Eigen::VectorXcd u;           ///< (n) increments of dofs and first-order unknowns
  Eigen::VectorXcd rate;        ///< (n) variations of their rates
  Eigen::VectorXcd multiplier;  ///< variations of all multipliers of the system; or empty
};

/// Increments [dx; dTheta] and variations of velocities [dv; dOmega] of a node, also of carried ones.
struct NodeVariation {
  Eigen::Matrix<std::complex<double>, 6, 1> position, rate;
};
NodeVariation node_variation(const System& system, const State& state, const Variation& variation, int node);

/// Variations over a component's local layout, including its references.
struct LocalVariation {
  Eigen::VectorXcd position, rate;
};
LocalVariation local_variation(const System& system, const State& state, const Variation& variation,
                               const Slots& slots);

}  // namespace bielle::mechanism
