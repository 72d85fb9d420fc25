// Valves whose opening follows a command, with two ports or with four (servo-valve).
//
// There are four ports P (supply), T (tank), A, B. A positive opening y connects P to A and B to T, a negative one P to
// B and A to T. Each of the four edges opens by
//     A_edge(y) = A_full s((|y| - overlap)/(1 - overlap)),   A_full: area of the edge,
// Here s is the identity above `smoothing` and zero below 0 (lines/opening.hpp). With a negative overlap all edges are
// open in the middle. Flows follow the orifice law.
#pragma once

#include <array>

#include "mechanism/hydraulics/lines/line.hpp"
#include "mechanism/hydraulics/lines/opening_lock.hpp"
#include "mechanism/hydraulics/lines/orifice_law.hpp"
#include "mechanism/hydraulics/lines/spool.hpp"
#include "mechanism/measures/time_formula.hpp"
#include "mechanism/model/lockable.hpp"

namespace bielle::mechanism {

class SpoolValve final : public Line, public TimeDependent, public Lockable {
 public:
  static constexpr double smoothing = 1e-3;  ///< fraction of the full opening
  struct Edge {
    std::string name;
    int from, to;      ///< ports
    double direction;  ///< +1: opens with y > 0, -1: with y < 0
    double area;       ///< area at full opening [m^2]
  };
  /// Constructs a valve with two ports, y from 0 to 1.
  SpoolValve(std::string name, const PressureNode& from, const PressureNode& to, const OrificeLaw& law, double area,
             double overlap);
  /// Constructs a valve with four ports. @param places  P, T, A, B; B nullptr: three ports @param areas  areas of P-A,
  /// B-T, P-B, A-T
  SpoolValve(std::string name, const std::array<const PressureNode*, 4>& places, const OrificeLaw& law,
             const std::array<double, 4>& areas, double overlap);
  Spool& spool() { return spool_; }
  References& formula_references() { return references(); }

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const override;
  void add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool knows_memory(const LocalState& state) const override { return OpeningLock::knows(state.memory()); }
  int lock_command_place() const override { return OpeningLock::command; }
  int locked_value_place() const override { return OpeningLock::opening; }
  double present_value(const LocalState& state) const override { return spool_.opening(state); }
  void add_break_points(std::vector<double>& times) const override { spool_.add_break_points(times); }
  std::vector<Formula> time_formulas() const override {
    return time_formulas_of(spool_.command_formula(), "command", "");
  }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  void add_edge(const std::string& name, int from, int to, double direction, double area);
  bool has_damping() const override { return spool_.reads_state(); }
  bool reads_reactions() const override { return spool_.reads_reactions(); }
  std::vector<OutputField> own_fields() const override;
  void write_own(const LocalState& state, double* values) const override { values[0] = spool_.opening(state); }
  std::string describe_law() const override;
  std::vector<std::string> own_measures() const override { return {"opening"}; }
  double calc_own_measure(const LocalState& state, const std::string& measure,
                          MeasureGradient& gradient) const override;
  OrificeLaw law_;
  double overlap_;
  std::vector<Edge> edges_;
  Spool spool_;
};

}  // namespace bielle::mechanism
