// Eigenvalues s and shapes of the linearised equations, the slowest first.
//
// Shapes move as exp(s t). The one with Im s >= 0 of a conjugate pair is given. Small systems are solved densely on the
// states that satisfy the constraints, large ones by ARPACK; both around a shift (shifted_operator.hpp) whose size
// follows from the slowest mode. Eigenvalues that belong to no motion (constraints, algebraic unknowns, directions
// without mass) are infinite, and recognised by two applications of the operator, which leave nothing of them.
//
// Rigid modes, motions that cost nothing, are found first (indifferent_motions.hpp) and kept out: the operator acts on
// the complement of their states, an invariant subspace. They are counted by shapes, not by eigenvalues (of a free body
// there are twice as many, in pairs). If modes are so slow that the shift which shows them does not show the others,
// they are kept out as well, and the rest is looked at from a shift of its own. That these are all modes is said where
// their number is that of the finite eigenvalues.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "mechanism/solvers/linearised/equations.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

enum class ModeKind { rigid, oscillating, decaying, growing };
const char* mode_kind_name(ModeKind kind);  ///< "oscillating"

struct Mode {
  std::complex<double> s;  ///< [1/s]; 0 of rigid modes
  ModeKind kind = ModeKind::oscillating;
  Eigen::VectorXcd u;  ///< increments of dofs and first-order unknowns (n), of any size
  Eigen::VectorXcd w;  ///< variations of the dofs' rates that go with them
  /// |ds| [1/s] by rounding of the equations, errors of the equilibrium (equation_rounding.hpp) and changes of the
  /// equations in a motion that is not quite steady; 0 where not known:
  /// for unsymmetric equations it is computed for modes that seem to grow. Rates up to the uncertainty of a rigid mode
  /// cannot be told from zero.
  double uncertainty = 0;
  double residual = 0;              ///< |T x - x / (s - sigma)| |s - sigma| / |x|, x the scaled state
  double frequency() const;         ///< |s| / 2 pi [Hz]
  double damped_frequency() const;  ///< |Im s| / 2 pi [Hz]
  double damping_ratio() const;     ///< -Re s / |s|; 0 of rigid modes
};

struct ModeOptions {
  int count = 20;                    ///< of modes that are not rigid; where `below` is given, it does not count
  std::optional<double> near = {};   ///< those nearest to this frequency [Hz] > 0; no rigid ones
  std::optional<double> below = {};  ///< all with |s| / 2 pi up to this frequency [Hz] > 0
  /// By what part the equations change while the motion goes on by a radian at this rate [1/s] (Steadiness::drift).
  double drift = 0, rate = 0;
  int dense = 300;  ///< systems of up to so many independent states are solved densely; 0: none
};

struct Modes {
  std::vector<Mode> modes;  ///< |s| ascending
  bool all = false;         ///< there are no others: as many as the equations have finite eigenvalues
  int states = 0;
  /// Growing motions that are not among the modes; nothing where that is not known (equations that are not symmetric).
  std::optional<int> growing_besides;
};

/// Sizes of rates from diagonal entries alone, of the softest and of the stiffest unknown [1/s].
double slowest_rate(const LinearisedEquations& equations);
double fastest_rate(const LinearisedEquations& equations);

/// Nothing determines some unknown: every number is an eigenvalue.
class SingularEquations : public ComputationError {
 public:
  explicit SingularEquations(int at);
  int at() const { return at_; }  ///< among the unknowns, then the constraints in the equations; or -1

 private:
  int at_;
};

/// @throws SingularEquations; ComputationError where ARPACK does not converge
Modes find_modes(const LinearisedEquations& equations, const ModeOptions& options);

}  // namespace bielle::mechanism
