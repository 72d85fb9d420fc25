// `eigen`: modes of small motions about the state of the session.
#pragma once

#include "mechanism/analyses/analysis.hpp"
#include "mechanism/analyses/modes.hpp"

namespace bielle::mechanism {

/// Its summary has the numbers "frequency" [Hz], "damping_ratio", "real" and "imaginary" parts of the eigenvalues
/// [1/s].
class EigenAnalysis : public Analysis {
 public:
  EigenAnalysis(ModesOptions options, bool shapes) : Analysis("eigen"), options_(std::move(options)), shapes_(shapes) {}
  const ModesOptions& options() const { return options_; }
  bool shapes() const { return shapes_; }  ///< whether shapes are written to the sinks

 private:
  void solve(Session& session, AnalysisSummary& summary) const override;
  ModesOptions options_;
  bool shapes_;
};

}  // namespace bielle::mechanism
