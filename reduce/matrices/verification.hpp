// The proof of stiffness and mass matrices that another program, or this one, computed.
//
// Limits. Matrices come through text with as few as eight significant digits (Nastran's PUNCH has nine, its small
// fields fewer, Abaqus and CalculiX twelve to sixteen); a sum over the row of a mesh loses one more. A number that
// should be zero may therefore reach 1e-6 of the size of its parts (`text_rounding`). Larger limits have their reason
// next to them.
#pragma once

#include <string>
#include <vector>

#include "reduce/matrices/matrix_set.hpp"
#include "reduce/reduction/checks.hpp"

namespace bielle::reduce {

inline constexpr double text_rounding = 1e-6;

/// A check with the sentence that explains its failure.
struct Finding {
  Check check;
  std::string fault;  ///< names unknowns and nodes; empty if the check passed

  bool passed() const { return check.passed(); }
};

/// A part of the verification: its findings, and lines of text for the reader.
struct VerifiedSubject {
  std::string title;
  std::vector<Finding> findings;
  std::vector<std::string> lines;
};

struct Verification {
  std::string name;    ///< name of the body
  std::string source;  ///< format and file
  Eigen::Index unknowns = 0, scalars = 0, nodes = 0;
  std::vector<VerifiedSubject> subjects;

  /// Findings that failed, the worst (by value over limit) first.
  std::vector<Finding> failures() const;
  std::size_t checks() const;
};

/// Verifies a set: symmetry and definiteness, rigid motions, positions, mass properties, units, modes, damping.
/// @throws ComputationError when memory does not suffice
Verification verify(MatrixSet set, int threads = 1);

}  // namespace bielle::reduce
