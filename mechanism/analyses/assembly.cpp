// `assembly`: positions and velocities are made consistent, and recorded.
#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/summary_text.hpp"

namespace bielle::mechanism {
namespace {

class AssemblyAnalysis : public Analysis {
 public:
  AssemblyAnalysis() : Analysis("assembly") {}
  std::size_t expected_rows(const Recording&) const override { return 1; }

 private:
  void solve(Session& session, AnalysisSummary& summary) const override {
    const StartReport start = session.assemble();
    summary.records = session.rows();
    summary.text = type() + "\n" + format_start(start) + format_mobility(session);
  }
};

}  // namespace

std::unique_ptr<Analysis> read_assembly(const YamlValue& entry, const Model&) {
  entry.check_keys({"type"}, "the analysis 'assembly'");
  return std::make_unique<AssemblyAnalysis>();
}

}  // namespace bielle::mechanism
