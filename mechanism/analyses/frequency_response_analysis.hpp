// `frequency_response`: frequency responses of small motions between inputs and outputs.
#pragma once

#include "mechanism/analyses/analysis.hpp"
#include "mechanism/analyses/frequency_response.hpp"

namespace bielle::mechanism {

/// Its summary has the numbers "peak" (for each output and input; all inputs of the first output come first) and
/// "peak_frequency" [Hz], and for a sum over modes "deviation".
class FrequencyResponseAnalysis : public Analysis {
 public:
  explicit FrequencyResponseAnalysis(FrequencyResponseOptions options)
      : Analysis("frequency_response"), options_(std::move(options)) {}
  const FrequencyResponseOptions& options() const { return options_; }

 private:
  void solve(Session& session, AnalysisSummary& summary) const override;
  FrequencyResponseOptions options_;
};

}  // namespace bielle::mechanism
