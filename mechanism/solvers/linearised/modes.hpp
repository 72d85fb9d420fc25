// Eigenvalues s and shapes of the linearised equations, the slowest first.
//
// Shapes move as exp(s t). A conjugate pair is represented by the eigenvalue with Im s >= 0. Small systems are solved
// densely on the states that satisfy the constraints, large ones by ARPACK; both use a shift (shifted_operator.hpp)
// whose size follows from the slowest mode. Eigenvalues that belong to no motion (constraints, algebraic unknowns,
// directions without mass) are infinite, and are recognised by two applications of the operator, which map their
// vectors to zero.
//
// Rigid modes, motions without stiffness, are found first (indifferent_motions.hpp) and excluded: the operator acts on
// the complement of their states, an invariant subspace. They are counted by shapes, not by eigenvalues (a free body
// has twice as many, in pairs). If modes are so slow that the shift that resolves them does not resolve the others,
// they are excluded as well, and the others are computed with another shift. The result states that these are all modes
// if their number is that of the finite eigenvalues.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "mechanism/solvers/linearised/equations.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

enum class ModeKind { rigid, oscillating, decaying, growing };
const char* mode_kind_name(ModeKind kind);  ///< name: "oscillating"

struct Mode {
  std::complex<double> s;  ///< eigenvalue [1/s]; 0 for rigid modes
  ModeKind kind = ModeKind::oscillating;
  Eigen::VectorXcd u;  ///< shape: increments of dofs and first-order unknowns (n), of any size
  Eigen::VectorXcd w;  ///< the corresponding variations of the dofs' rates
  /// |ds| [1/s] due to rounding of the equations, errors of the equilibrium (equation_rounding.hpp) and changes of the
  /// equations in a motion that is not exactly steady; 0 if not known: for unsymmetric equations it is only computed
  /// for modes that seem to grow. Rates below the uncertainty of a rigid mode cannot be distinguished from zero.
  double uncertainty = 0;
  double residual = 0;              ///< |T x - x / (s - sigma)| |s - sigma| / |x|, with the scaled state x
  double frequency() const;         ///< |s| / 2 pi [Hz]
  double damped_frequency() const;  ///< |Im s| / 2 pi [Hz]
  double damping_ratio() const;     ///< -Re s / |s|; 0 for rigid modes
};

struct ModeOptions {
  int count = 20;                    ///< number of modes that are not rigid; ignored if `below` is given
  std::optional<double> near = {};   ///< selects those nearest to this frequency [Hz] > 0; no rigid ones
  std::optional<double> below = {};  ///< selects all with |s| / 2 pi up to this frequency [Hz] > 0
  /// Relative change of the equations while the motion proceeds by a radian at this rate [1/s] (Steadiness::drift).
  double drift = 0, rate = 0;
  int dense = 300;  ///< systems of up to this number of independent states are solved densely; 0: none
};

struct Modes {
  std::vector<Mode> modes;  ///< |s| ascending
  bool all = false;         ///< there are no others: the number equals that of the finite eigenvalues
  int states = 0;
  /// Number of growing motions that are not among the modes; no value if it is not known (equations that are not
  /// symmetric).
  std::optional<int> growing_besides;
};

/// Estimates of rates from diagonal entries only, for the softest and for the stiffest unknown [1/s].
double slowest_rate(const LinearisedEquations& equations);
double fastest_rate(const LinearisedEquations& equations);

/// Some unknown is not determined: every number is an eigenvalue.
class SingularEquations : public ComputationError {
 public:
  explicit SingularEquations(int at);
  int at() const { return at_; }  ///< index among the unknowns, then the active constraints; or -1

 private:
  int at_;
};

/// @throws SingularEquations; ComputationError if ARPACK does not converge
Modes find_modes(const LinearisedEquations& equations, const ModeOptions& options);

}  // namespace bielle::mechanism
