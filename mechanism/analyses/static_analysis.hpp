// `static`: equilibrium by load steps, or along a path past limit points.
#pragma once

#include "mechanism/analyses/analysis.hpp"
#include "mechanism/analyses/statics.hpp"

namespace bielle::mechanism {

/// Its summary has the numbers "load_factor" at the end and "limit_points".
class StaticAnalysis : public Analysis {
 public:
  explicit StaticAnalysis(StaticsOptions options) : Analysis("static"), options_(std::move(options)) {}
  const StaticsOptions& options() const { return options_; }
  std::string place(const Session& session) const override;
  std::size_t expected_rows(const Recording&) const override {
    return options_.steps == 0 || options_.path ? 0 : static_cast<std::size_t>(options_.steps) + 1;
  }

 private:
  void solve(Session& session, AnalysisSummary& summary) const override;
  StaticsOptions options_;
};

}  // namespace bielle::mechanism
