// `dynamic`: the motion over an interval of time.
#pragma once

#include "mechanism/analyses/analysis.hpp"

namespace bielle::mechanism {

/// Its summary has the numbers "end_time" [s], "steps" and "balance" of energy [J].
class DynamicAnalysis : public Analysis {
 public:
  /// @param scheme  the scheme in words, for the summary
  DynamicAnalysis(DynamicsOptions options, std::string scheme)
      : Analysis("dynamic"), options_(std::move(options)), scheme_(std::move(scheme)) {}
  const DynamicsOptions& options() const { return options_; }
  bool can_go_on() const override { return true; }
  double duration() const override { return options_.duration; }
  std::size_t expected_rows(const Recording& recording) const override;

 private:
  void solve(Session& session, AnalysisSummary& summary) const override;
  void solve_rest(Session& session, const std::vector<double>& checkpoint, ResultSink& sink,
                  AnalysisSummary& summary) const override;
  void finish(Session& session, Motion& motion, const std::string& heading, AnalysisSummary& summary) const;
  DynamicsOptions options_;
  std::string scheme_;
};

}  // namespace bielle::mechanism
