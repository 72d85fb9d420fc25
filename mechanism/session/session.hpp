// A model in use by a program: it can be assembled, moved, read and saved, without a file. Other analyses are functions
// of a session (mechanism/analyses/statics.hpp, modes.hpp, ..).
//
//     Session session(read_mechanism_text(text, "pendulum").model);
//     session.assemble();
//     DynamicsOptions options;
//     options.duration = 2;
//     options.stepping.size = 1e-3;
//     Motion motion = session.dynamics(options);
//     motion.advance_to(1);
//     const double angle = session.read("joints/hinge/coordinate")[0];
//
// Each computation starts from the state at the end of the last one. Results are sent to any number of sinks while an
// analysis is open (an Analysis opens one itself).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "mechanism/results/results_rows.hpp"
#include "mechanism/session/assembly_options.hpp"
#include "mechanism/session/gauge.hpp"
#include "mechanism/session/motion.hpp"
#include "mechanism/session/notes.hpp"
#include "mechanism/session/recorder.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"

namespace bielle::mechanism {

class Session {
 public:
  /// Numbers the model's unknowns; redundant constraints are found and set aside.
  /// @throws InputError, ComputationError
  /// @param threads  number of threads that evaluate costly components in parallel; the results do not depend on it
  explicit Session(Model&& model, int threads = 1);
  explicit Session(const Model& model, int threads = 1);  ///< the model must outlive the session
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const Model& model() const { return model_; }
  const System& system() const { return system_; }
  const std::vector<std::string>& redundant() const { return redundant_; }  ///< set aside, by joint
  const Mobility& mobility() const { return mobility_; }                    ///< mobility at the start of the model

  // -- environment
  const Environment& environment() const { return environment_; }  ///< under the whole load
  const Environment& acting() const { return acting_; }            ///< under the present load factor
  const Loaded& loaded() const { return loaded_; }                 ///< fractions of loads and motions applied so far
  /// The start conditions of the model, until a computation has started.
  StartConditions start_conditions() const;
  /// Sets an input of the model (`inputs`), which formulas use. In a motion it is valid from the present time on:
  /// forces jump, and the motion is restarted with its next step.
  /// @param smooth  the value belongs to a smooth function of time, sampled once a step: the motion is not restarted
  /// @throws InputError naming the nearest name
  void set_input(const std::string& name, double value, bool smooth = false);

  // -- computing
  /// Makes positions and velocities consistent. The first assembly, static analysis or motion starts from the values
  /// and rates of coordinates that the model gives. @throws ComputationError naming the conditions that cannot be
  /// satisfied
  StartReport assemble(const AssemblyOptions& options = {});
  /// Creates a motion that starts from the present state, made consistent. The motion must not outlive the session.
  Motion dynamics(const DynamicsOptions& options);
  /// Continues a motion from the numbers written by `save`: the results are those of an uninterrupted motion. The step
  /// options may differ from the earlier ones. @throws InputError if the numbers are not those of a motion of this
  /// model
  Motion dynamics(const DynamicsOptions& options, const std::vector<double>& saved);
  /// Continues a motion from the numbers kept by a sink (ResultSink::checkpoint). @param sink  sink whose part is among
  /// the numbers
  Motion dynamics(const DynamicsOptions& options, const std::vector<double>& checkpoint, ResultSink& sink);

  // -- reading
  const State& state() const { return *shown_; }  ///< state of the motion, while one is in progress
  double time() const { return shown_->time; }    ///< time [s]
  bool moving() const { return motion_ != nullptr; }
  /// Sets the state, and ends a motion. @throws InputError if it is not a state of this model (system/check_state.hpp);
  /// nothing is then changed
  void set_state(State state);
  /// Position, axes, velocities and accelerations of a node. @throws InputError naming the nearest name
  const NodeState& node(const std::string& name) const;
  /// Reads a dataset of the results file at the present state: "joints/main/coordinate", "nodes/tip/velocity",
  /// "energy/kinetic", "time". Quantities that `only` excludes from the rows can be read as well. Quaternions have w >=
  /// 0.
  /// @throws InputError naming the nearest name
  std::vector<double> read(const std::string& dataset) const;
  /// Reads a dataset that was looked up before. Every dataset except "time" has a column, which contains its shape.
  std::vector<double> read(const ResultsColumn& column) const;
  ResultsColumn column(const std::string& dataset) const;  ///< @throws InputError naming the nearest name
  /// Value of a measure as named in formulas, at the present state: "main.angle", "main.angle.rate", "pin.position.x",
  /// or a measure, input or state of the model. @throws InputError naming the nearest name
  double measure(const std::string& name) const;
  const std::vector<ResultsColumn>& datasets() const;  ///< datasets that can be read
  /// Present stored energies; input and dissipation since the start of the motion [J].
  Energy energy() const { return report().energy; }
  double balance() const { return report().balance; }  ///< missing energy [J]
  StepRecord report() const;                           ///< report of the last step

  // -- callbacks
  /// Adds a callback that is called after each step of a motion and each point of statics, after it has been recorded,
  /// and with each state of a sweep over a speed; it may call `stop`. An exception that it throws ends the run.
  void on_step(std::function<void(Session&)> callback) { on_step_.push_back(std::move(callback)); }
  /// Adds a callback that is called with every attempted step, accepted or not.
  void on_attempt(std::function<void(const Attempt&)> callback) { on_attempt_.push_back(std::move(callback)); }
  bool watches_attempts() const { return !on_attempt_.empty(); }
  /// Adds a callback that is called with each event of a motion, after the step that ends on it.
  void on_event(std::function<void(const Event&)> callback) { on_event_.push_back(std::move(callback)); }
  /// Ends the present computation after its current step.
  void stop() { stopping_ = true; }
  bool stopping() const { return stopping_; }  ///< true until the next computation is started
  void forget_stop() { stopping_ = false; }
  /// Calls the callbacks; to be called after each point of an analysis.
  void call_back();
  /// @param notes  must outlive its use; nullptr: no messages
  void set_notes(Notes* notes) { notes_ = notes; }
  Notes* notes() const { return notes_; }

  // -- saving
  /// Returns all numbers that the session needs to continue. The rows recorded by sinks are not included.
  std::vector<double> save();
  /// Restores saved numbers, of this session or of another one of the same model. If a motion was saved, a motion must
  /// be in progress here; it continues identically if it has the same options.
  /// @throws InputError if the numbers are of another model, or no motion is in progress; the state is then unchanged
  void restore(const std::vector<double>& saved);

  // -- recording
  void add_sink(ResultSink& sink) { recorder_.add_sink(sink); }              ///< the sink must outlive its use
  void remove_sink(const ResultSink& sink) { recorder_.remove_sink(sink); }  ///< the sink receives no more data
  /// @throws InputError if the interval of steps is less than 1
  void set_recording(Recording recording) { recorder_.set_recording(std::move(recording)); }
  const Recording& recording() const { return recorder_.recording(); }
  /// Begins an analysis: the following results are recorded under this name, until the analysis ends or, after a
  /// failure, another begins.
  /// @param goes_on  a sink in which the analysis is already open
  void begin_analysis(const std::string& type, std::size_t expected_rows = 0, const ResultSink* goes_on = nullptr) {
    recorder_.begin_analysis(type, expected_rows, goes_on);
  }
  void write(const ResultArray& array) { recorder_.write(array); }  ///< writes a result that is not a row
  void write(const ResultNames& names) { recorder_.write(names); }
  void end_analysis() { recorder_.end_analysis(*shown_, acting_); }  ///< writes the results of the step recorders
  /// Call this function after a failure: nothing more is recorded of the analysis.
  void abandon_analysis() { recorder_.abandon_analysis(); }
  /// Call this function at each state that an analysis has found: an accepted step, a start, an equilibrium in
  /// rotation.
  void gather(const State& state, const Environment& environment) { recorder_.gather(state, environment); }
  /// Summary of the step recorders of this analysis, as lines for the user.
  std::string gathered() { return recorder_.step_recorders().summary(); }
  Recorder& recorder() { return recorder_; }
  long rows() const { return recorder_.rows(); }  ///< number of rows of this analysis

 private:
  friend class Computation;
  Session(std::unique_ptr<const Model> owned, const Model* model, int threads);
  void at_rest();  ///< ends the motion, if any
  const ResultsRows& readable() const;
  struct Saved;
  void exchange(Archive& archive, Saved& saved) const;

  std::unique_ptr<const Model> owned_;
  const Model& model_;
  System system_;
  Environment environment_, acting_;
  State state_;           ///< state while no motion is in progress
  const State* shown_;    ///< state_, or that of the computation
  Loaded loaded_;         ///< fractions of loads and motions applied so far
  bool started_ = false;  ///< the state is no longer that of the model file
  Motion* motion_ = nullptr;
  std::optional<StepRecord> report_;
  std::vector<std::string> redundant_;
  Mobility mobility_;
  mutable std::unique_ptr<ResultsRows> readable_;          ///< created at the first reading
  mutable std::vector<ResultsColumn> datasets_;            ///< created at the first reading
  mutable std::unordered_map<std::string, Gauge> gauges_;  ///< gauges of the requested measures

  Recorder recorder_;
  std::vector<std::function<void(Session&)>> on_step_;
  std::vector<std::function<void(const Attempt&)>> on_attempt_;
  std::vector<std::function<void(const Event&)>> on_event_;
  Notes* notes_ = nullptr;
  bool stopping_ = false;
};

}  // namespace bielle::mechanism
