// `kinematic` and `inverse_dynamics`: a mechanism whose motions are all driven, at a sequence of times.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/step_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/session/time_grid.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

std::string format_elastic(const KinematicsReport& report) {
  if (!report.elastic) return {};
  constexpr double much = 0.05;
  std::string text = fmt::format(
      "  elastic parts follow in equilibrium under inertia forces (quasi-static): the accelerations of that "
      "deformation, "
      "which are left out, reach {:.2g} % of the largest acceleration{}\n",
      100 * report.left_out, report.left_out > much ? "; take a dynamic analysis for what vibrates" : "");
  if (!report.indifferent.empty())
    text += fmt::format("  neither driven nor loaded, at rest: {}\n", fmt::join(report.indifferent, ", "));
  return text;
}

std::string format_events(const KinematicsReport& report) {
  if (report.events == 0) return {};
  return fmt::format("  {}, the last: {}{}\n", counted(report.events, "event"), report.last_event,
                     report.stopped_by_event ? ", which stopped the run" : "");
}

class KinematicAnalysis final : public Analysis {
 public:
  KinematicAnalysis(const std::string& type, KinematicsOptions options) : Analysis(type), options_(options) {}
  double duration() const override { return options_.duration; }
  std::size_t expected_rows(const Recording& recording) const override {
    if (!recording.times.empty()) return recording.times.size() + 1;
    return static_cast<std::size_t>(grid_steps(options_.duration, options_.step) / recording.every) + 2;
  }

 private:
  void solve(Session& session, AnalysisSummary& summary) const override {
    const KinematicsReport report = compute_kinematics(session, options_);
    summary.records = session.rows();
    summary.text = fmt::format("{}, {}\n", type() == "kinematic" ? "kinematics" : "inverse dynamics",
                               counted(report.points, "position"));
    summary.text += format_start(report.start) + format_mobility(session) + format_elastic(report);
    summary.text += format_energies(report.energy) + format_events(report);
  }
  KinematicsOptions options_;
};

std::vector<Key> keys_of(const std::string& type) {
  using namespace keys;
  return {analysis_type_key(type),
          {"duration", number("s").positive(), required, "Duration of the motion."},
          {"step", number("s").positive(), required, "Time from one position to the next."}};
}

std::unique_ptr<Analysis> read(const YamlValue& entry, const std::string& type) {
  KinematicsOptions options;
  options.duration = entry.at("duration").number();
  options.step = entry.at("step").number();
  check_step(entry, "step", options.step, options.duration);
  options.elastic = type == "inverse_dynamics";
  return std::make_unique<KinematicAnalysis>(type, options);
}

}  // namespace

const KeyTable& kinematic_keys() {
  static const KeyTable table{"the analysis 'kinematic'", "Motion of rigid parts that is driven completely.",
                              keys_of("kinematic")};
  return table;
}

const KeyTable& inverse_dynamics_keys() {
  static const KeyTable table{"the analysis 'inverse_dynamics'",
                              "Forces of a motion that is driven completely; elastic parts follow in equilibrium.",
                              keys_of("inverse_dynamics")};
  return table;
}

std::unique_ptr<Analysis> read_kinematic(const YamlValue& entry, const Model& /*model*/) {
  return read(entry, "kinematic");
}

std::unique_ptr<Analysis> read_inverse_dynamics(const YamlValue& entry, const Model& /*model*/) {
  return read(entry, "inverse_dynamics");
}

}  // namespace bielle::mechanism
