#include "reduce/report/verification_report.hpp"

#include <fmt/format.h>

#include "reduce/common/counted.hpp"

namespace bielle::reduce {

namespace {

std::string verdict_of(const Verification& verification) {
  const std::vector<Finding> failures = verification.failures();
  const std::size_t checks = verification.checks();
  if (failures.empty()) return fmt::format("verified: {} passed\n", counted(checks, "check"));
  std::string text = fmt::format("{} of {} fail{}: {}\n", failures.size(), counted(checks, "check"),
                                 failures.size() == 1 ? "s" : "", failures[0].fault);
  for (std::size_t k = 1; k < failures.size(); ++k) text += fmt::format("  {}\n", failures[k].fault);
  return text;
}

}  // namespace

std::string describe(const Verification& verification) {
  std::string text =
      fmt::format("{}: {}\n{}, {} of them scalars, at {}\n", verification.name.empty() ? "body" : verification.name,
                  verification.source, counted(verification.unknowns, "unknown"), verification.scalars,
                  counted(verification.nodes, "node")) +
      verdict_of(verification);
  for (const VerifiedSubject& subject : verification.subjects) {
    if (subject.findings.empty() && subject.lines.empty()) continue;
    text += fmt::format("\n{}\n", subject.title);
    for (const Finding& finding : subject.findings)
      text += fmt::format("  {}  {:8.1e} (at most {:.0e})  {}\n", finding.passed() ? "passed" : "FAILED",
                          finding.check.value, finding.check.limit, finding.check.meaning);
    for (const std::string& line : subject.lines) text += fmt::format("  {}\n", line);
  }
  return text;
}

}  // namespace bielle::reduce
