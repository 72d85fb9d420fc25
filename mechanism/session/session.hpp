// A model at work, for programs: assemble it, move it, read it, save it, without a file. Other analyses are functions
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
// What is asked for one after the other starts where the last thing ended. Results go to any number of sinks while an
// analysis is open (an Analysis opens one itself).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "mechanism/results/recording.hpp"
#include "mechanism/results/result_sink.hpp"
#include "mechanism/results/results_rows.hpp"
#include "mechanism/session/assembly_options.hpp"
#include "mechanism/session/gatherers.hpp"
#include "mechanism/session/gauge.hpp"
#include "mechanism/session/motion.hpp"
#include "mechanism/session/notes.hpp"
#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"

namespace bielle::mechanism {

class Session {
 public:
  /// Numbers the model's unknowns; constraints that repeat others are found, and set aside.
  /// @throws InputError, ComputationError
  /// @param threads  that evaluate costly components at the same time; the numbers do not depend on them
  explicit Session(Model&& model, int threads = 1);
  explicit Session(const Model& model, int threads = 1);  ///< which must outlive the session
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const Model& model() const { return model_; }
  const System& system() const { return system_; }
  const std::vector<std::string>& redundant() const { return redundant_; }  ///< constraints set aside, by joint
  const Mobility& mobility() const { return mobility_; }                    ///< where the model starts

  // -- what acts
  const Environment& environment() const { return environment_; }  ///< of the whole load
  const Environment& acting() const { return acting_; }            ///< of the load factor that the state stands under
  const Loaded& loaded() const { return loaded_; }                 ///< what of loads and motions has been made
  /// What the model asks of a start, until something has started.
  StartConditions start_conditions() const;
  /// Sets an input of the model (`inputs`), that formulas use. In a motion it holds from here on: forces jump, and the
  /// motion is restarted with its next step.
  /// @param smooth  the value is one of a smooth function of time, seen once a step: nothing jumps
  /// @throws InputError with the nearest name
  void set_input(const std::string& name, double value, bool smooth = false);

  // -- computing
  /// Makes positions and velocities consistent. What starts first, this or statics or a motion, starts from the values
  /// and rates of coordinates that the model gives. @throws ComputationError naming what cannot be satisfied
  StartReport assemble(const AssemblyOptions& options = {});
  /// A motion from the state, made consistent. It must not outlive the session.
  Motion dynamics(const DynamicsOptions& options);
  /// Goes on with a motion as `save` left it: its numbers are those of a motion that was not interrupted. Steps may be
  /// others than before. @throws InputError when the numbers are not those of a motion of this model
  Motion dynamics(const DynamicsOptions& options, const std::vector<double>& saved);
  /// The same from what a sink keeps (ResultSink::checkpoint). @param sink  whose part stands among the numbers
  Motion dynamics(const DynamicsOptions& options, const std::vector<double>& checkpoint, ResultSink& sink);

  // -- reading
  const State& state() const { return *shown_; }  ///< of the motion, while one is under way
  double time() const { return shown_->time; }    ///< [s]
  bool moving() const { return motion_ != nullptr; }
  /// Ends a motion. @throws InputError when it is no state of this model (system/check_state.hpp); nothing has happened
  void set_state(State state);
  /// Position, axes, velocities and accelerations of a node. @throws InputError with the nearest name
  const NodeState& node(const std::string& name) const;
  /// A dataset of the results file at the state: "joints/main/coordinate", "nodes/tip/velocity", "energy/kinetic",
  /// "time". What `only` leaves out of the rows can be read as well. Quaternions have w >= 0.
  /// @throws InputError with the nearest name
  std::vector<double> read(const std::string& dataset) const;
  /// The same of one that was found before. Any dataset but "time" has a column, which knows its shape.
  std::vector<double> read(const ResultsColumn& column) const;
  ResultsColumn column(const std::string& dataset) const;  ///< @throws InputError with the nearest name
  /// What formulas call by this name, at the state: "main.angle", "main.angle.rate", "pin.position.x", or a measure,
  /// input or state of the model. @throws InputError with the nearest name
  double measure(const std::string& name) const;
  const std::vector<ResultsColumn>& datasets() const;  ///< that can be read: names, shapes, units
  /// Stored energies now; input and dissipation since the start of the motion [J].
  Energy energy() const { return report().energy; }
  double balance() const { return report().balance; }  ///< of energy: what is missing [J]
  StepRecord report() const;                           ///< of the last step

  // -- calling back
  /// Called after each step of a motion and each point of statics, once it is recorded, and with each state of a sweep
  /// over a speed; may ask to `stop`. What it throws ends the run.
  void on_step(std::function<void(Session&)> callback) { on_step_.push_back(std::move(callback)); }
  /// Called with every step that is tried, accepted or not.
  void on_attempt(std::function<void(const Attempt&)> callback) { on_attempt_.push_back(std::move(callback)); }
  /// Called with each crossing of a motion, after the step that ends on it.
  void on_event(std::function<void(const Event&)> callback) { on_event_.push_back(std::move(callback)); }
  /// Ends the present computation after the current step.
  void stop() { stopping_ = true; }
  bool stopping() const { return stopping_; }  ///< until the next computation is started
  void forget_stop() { stopping_ = false; }
  /// Call after each point of an analysis.
  void call_back();
  /// @param notes  must outlive its use; nullptr: silence
  void set_notes(Notes* notes) { notes_ = notes; }
  Notes* notes() const { return notes_; }

  // -- saving
  /// Everything that the session needs to continue. What sinks have recorded is not part of it.
  std::vector<double> save();
  /// Goes back to what was saved, of this session or of another one of the same model. Where that was in motion, a
  /// motion has to be under way here, with the same options to continue identically.
  /// @throws InputError when the numbers are of another model, or no motion is under way; the state stays as it is
  void restore(const std::vector<double>& saved);

  // -- recording
  void add_sink(ResultSink& sink) { sinks_.push_back(&sink); }  ///< which must outlive its use
  void remove_sink(const ResultSink& sink);                     ///< which gets nothing more
  void set_recording(Recording recording);
  const Recording& recording() const { return recording_; }
  /// What follows is recorded under this name, until the analysis ends or, where it failed, another begins.
  /// @param goes_on  a sink that has the analysis open already
  void begin_analysis(const std::string& type, std::size_t expected_rows = 0, const ResultSink* goes_on = nullptr);
  void write(const ResultArray& array);  ///< a result that is no row
  void write(const ResultNames& names);
  void end_analysis();                        ///< writes what components have gathered
  void abandon_analysis() { open_ = false; }  ///< it has failed: nothing more is recorded of it
  /// Call at each state that an analysis has found: an accepted step, a start, an equilibrium in rotation.
  void gather(const State& state, const Environment& environment);
  /// What components have gathered over the steps of this analysis, in lines for the user.
  std::string gathered() { return gatherers_.summary(); }
  long rows() const { return rows_; }  ///< recorded in this analysis

 private:
  friend class Motion;
  friend class Computation;
  Session(std::unique_ptr<const Model> owned, const Model* model, int threads);
  void at_rest();  ///< ends the motion, if any
  void record(const State& state, const Environment& environment, const StepRecord& step);
  /// The state with the reactions to report.
  const State& reported(const State& state, const Environment& environment) const;
  void note(const Event& event);
  void note(const std::string& sentence) const;
  const ResultsRows& readable() const;
  struct Saved;
  void exchange(Archive& archive, Saved& saved) const;

  std::unique_ptr<const Model> owned_;
  const Model& model_;
  System system_;
  Environment environment_, acting_;
  State state_;           ///< while no motion is under way
  const State* shown_;    ///< that, or the one in hand
  Loaded loaded_;         ///< what has been brought about so far
  bool started_ = false;  ///< the state is no longer the drawing
  Motion* motion_ = nullptr;
  std::optional<StepRecord> report_;
  std::vector<std::string> redundant_;
  Mobility mobility_;
  mutable std::unique_ptr<ResultsRows> readable_;  ///< made with the first reading
  mutable std::vector<ResultsColumn> datasets_;    ///< likewise
  mutable std::unique_ptr<ReactionNorm> norm_;     ///< made where constraints are redundant
  mutable State reported_;
  mutable std::unordered_map<std::string, Gauge> gauges_;  ///< of the measures that were asked for

  Recording recording_;
  std::vector<ResultSink*> sinks_;
  Gatherers gatherers_;
  bool open_ = false;  ///< an analysis
  long rows_ = 0;
  std::vector<std::function<void(Session&)>> on_step_;
  std::vector<std::function<void(const Attempt&)>> on_attempt_;
  std::vector<std::function<void(const Event&)>> on_event_;
  Notes* notes_ = nullptr;
  bool stopping_ = false;
  bool going_again_ = false;  ///< over steps that were seen before
};

}  // namespace bielle::mechanism
