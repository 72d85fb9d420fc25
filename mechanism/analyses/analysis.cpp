#include "mechanism/analyses/analysis.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace bielle::mechanism {

AnalysisSummary Analysis::run(Session& session) const {
  AnalysisSummary summary;
  session.begin_analysis(type_, expected_rows(session.recording()));
  solve(session, summary);
  session.end_analysis();
  summary.text += session.gathered();
  return summary;
}

AnalysisSummary Analysis::go_on(Session& session, const std::vector<double>& checkpoint, ResultSink& sink) const {
  AnalysisSummary summary;
  session.begin_analysis(type_, 0, &sink);
  solve_rest(session, checkpoint, sink, summary);
  session.end_analysis();
  summary.text += session.gathered();
  return summary;
}

std::string Analysis::place(const Session& session) const { return fmt::format("t = {:.6g} s", session.time()); }

void Analysis::solve_rest(Session&, const std::vector<double>&, ResultSink&, AnalysisSummary&) const {
  throw std::logic_error("the analysis '" + type_ + "' cannot go on from a checkpoint");
}

}  // namespace bielle::mechanism
