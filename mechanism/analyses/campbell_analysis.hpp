// `campbell`: frequencies over the speed of a rotor, with modes tracked by their shapes, and critical speeds.
#pragma once

#include "mechanism/analyses/analysis.hpp"
#include "mechanism/analyses/campbell.hpp"

namespace bielle::mechanism {

/// Its summary has the numbers "critical_speed" [rad/s], "critical_frequency" [Hz], "critical_mode" (from 1) and
/// "critical_order".
class CampbellAnalysis : public Analysis {
 public:
  explicit CampbellAnalysis(CampbellOptions options) : Analysis("campbell"), options_(std::move(options)) {}
  const CampbellOptions& options() const { return options_; }
  void set_maker(const ModelMaker& maker) override { options_.maker = maker; }

 private:
  void solve(Session& session, AnalysisSummary& summary) const override;
  std::string format(const Campbell& found) const;
  std::string at(double value, double speed) const;  ///< "93.1 rad/s", "rpm = 1200 (125.7 rad/s)"
  CampbellOptions options_;
};

}  // namespace bielle::mechanism
