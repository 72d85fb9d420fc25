// `state_space`: small motions between inputs and outputs as matrices.
#pragma once

#include "mechanism/analyses/analysis.hpp"
#include "mechanism/analyses/state_space.hpp"

namespace bielle::mechanism {

/// Its summary has the number "states".
class StateSpaceAnalysis : public Analysis {
 public:
  explicit StateSpaceAnalysis(StateSpaceOptions options) : Analysis("state_space"), options_(std::move(options)) {}
  const StateSpaceOptions& options() const { return options_; }

 private:
  void solve(Session& session, AnalysisSummary& summary) const override;
  StateSpaceOptions options_;
};

}  // namespace bielle::mechanism
