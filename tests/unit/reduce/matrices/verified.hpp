// Functions that return results of a verification by name.
#pragma once

#include <cmath>
#include <string>

#include "reduce/matrices/verification.hpp"

namespace bielle::test {

/// Returns the faults of all checks that failed, the worst first, one on each line.
inline std::string faults_of(const reduce::Verification& verification) {
  std::string text;
  for (const reduce::Finding& finding : verification.failures())
    text += finding.check.name + ": " + finding.fault + "\n";
  return text;
}

inline std::string faults_of(const reduce::MatrixSet& set) { return faults_of(reduce::verify(set)); }

/// Returns the number of a check, or NaN if it was not made.
inline double value_of(const reduce::Verification& verification, const std::string& name) {
  for (const reduce::VerifiedSubject& subject : verification.subjects)
    for (const reduce::Finding& finding : subject.findings)
      if (finding.check.name == name) return finding.check.value;
  return std::nan("");
}

/// Adds to an entry of a sparse matrix.
inline void add_to(reduce::SparseColumns& matrix, Eigen::Index row, Eigen::Index column, double value) {
  matrix.coeffRef(row, column) += value;
}

}  // namespace bielle::test
