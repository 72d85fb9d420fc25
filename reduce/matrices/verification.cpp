#include "reduce/matrices/verification.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/matrices/verified_subjects.hpp"

namespace bielle::reduce {

namespace {

/// Removes unknowns that have neither stiffness nor mass, and names them.
VerifiedSubject remove_and_name_empty(MatrixSet& set) {
  const std::vector<NodalUnknown> before = set.unknowns;
  MatrixSet names;  // the names of all unknowns
  names.numbers = set.numbers;
  names.unknowns = before;
  VerifiedSubject subject{"unknowns", {}, {}};
  if (remove_empty_unknowns(set) == 0) return subject;
  Unknowns empty;
  std::size_t next = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const bool kept = next < set.unknowns.size() && set.unknowns[next].node == before[k].node &&
                      set.unknowns[next].component == before[k].component;
    kept ? void(++next) : empty.push_back(static_cast<Eigen::Index>(k));
  }
  subject.lines.push_back(fmt::format(
      "{} neither stiffness nor mass: {}",
      empty.size() == 1 ? "1 unknown has" : fmt::format("{} unknowns have", empty.size()), names_of(names, empty)));
  return subject;
}

}  // namespace

std::vector<Finding> Verification::failures() const {
  std::vector<Finding> result;
  for (const VerifiedSubject& subject : subjects)
    std::copy_if(subject.findings.begin(), subject.findings.end(), std::back_inserter(result),
                 [](const Finding& finding) { return !finding.passed(); });
  const auto excess = [](const Finding& finding) { return finding.check.value / std::max(finding.check.limit, 1e-12); };
  std::stable_sort(result.begin(), result.end(),
                   [&](const Finding& a, const Finding& b) { return excess(a) > excess(b); });
  return result;
}

std::size_t Verification::checks() const {
  std::size_t count = 0;
  for (const VerifiedSubject& subject : subjects) count += subject.findings.size();
  return count;
}

Verification verify(MatrixSet set, int threads) {
  Verification result;
  result.name = set.name;
  result.source = set.source;
  result.nodes = set.positions.cols();
  clear_rounding(set);
  result.subjects.push_back(remove_and_name_empty(set));
  result.unknowns = set.size();
  result.scalars = set.scalars();
  if (set.size() == 0) {
    result.subjects[0].findings.push_back(
        {{"emptiness", 1, 0, "the matrices have entries"}, "the matrices have no entries"});
    return result;
  }
  const MatrixStudy study = study_matrices(set, threads);
  double scale = 1;
  result.subjects.push_back(verify_entries(study));
  result.subjects.push_back(verify_rigid_motions(study));
  result.subjects.push_back(verify_positions(study, scale));
  result.subjects.push_back(verify_mass(study));
  if (scale == 1)
    result.subjects.push_back(verify_units(study));  // positions of a wrong unit have a finding of their own
  result.subjects.push_back(verify_modes(study));
  result.subjects.push_back(verify_parts(study));
  result.subjects.push_back(verify_recovery(study));
  return result;
}

}  // namespace bielle::reduce
