// A motion under way: made by Session::dynamics, moved on step by step.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/results/step_record.hpp"
#include "mechanism/session/assembly_options.hpp"
#include "mechanism/session/energy_balance.hpp"
#include "mechanism/session/prescribed_jumps.hpp"
#include "mechanism/solvers/dynamics/march.hpp"

namespace bielle::mechanism {

class Notes;
class ResultSink;
class Session;

struct DynamicsOptions {
  double duration = 0;   ///< [s] > 0
  StepOptions stepping;  ///< without break points: those of the model are found
  Scheme scheme = Scheme::generalized_alpha(0.8);
  ConstraintForm form = ConstraintForm::corrected;
  NewtonOptions newton;
  bool equilibrium = false;                       ///< positions of static equilibrium first
  std::vector<AssemblyOptions::Coordinate> held;  ///< coordinates that stay where they start while the rest settles
};

/// The session shows the state of its motion as long as that lives, and keeps the last one. A motion ends when the
/// session starts something else: its state can still be read then, but it moves no further (std::logic_error).
class Motion {
 public:
  ~Motion();
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  /// Takes a step, with the rows and checkpoints that the session's recording asks for, and calls back. With fixed
  /// steps, smaller ones may lie between two times of the grid. @returns false when none is left
  /// @throws ComputationError as March::advance; the motion then stands where it was before the step
  bool step();
  /// Steps until the time is reached: exactly where it is on the grid of steps, otherwise beyond it by less than a
  /// step (`interpolated` gives the state in between). @returns false when a callback stopped it, or the end came first
  bool advance_to(double time);
  /// Steps to the end. What ends it early, a stop or an exception, leaves a checkpoint with the sinks, a stop its last
  /// row as well. @returns false when it was stopped
  bool finish();
  bool done() const { return parts_.march->done(); }
  bool stopped_by_event() const { return parts_.march->stopped(); }
  const std::string& last_event() const { return last_event_; }  ///< its name; empty: there was none
  double begin() const { return parts_.begin; }                  ///< [s]
  double end() const { return end_; }                            ///< [s]
  double time() const { return state().time; }                   ///< [s]

  const State& state() const { return parts_.integration->state(); }
  /// @param time  within the last step [s]. @throws InputError when it is not
  State interpolated(double time) const;
  /// Stored energies now, input and dissipation since the start [J].
  const Energy& energy() const { return parts_.books.totals(); }
  double balance() const { return parts_.books.balance(); }  ///< what is missing [J]
  const EnergyBalance& books() const { return parts_.books; }
  /// What the scheme's own damping has taken out since the start [J].
  double scheme_loss() const { return parts_.integration->scheme_loss(); }
  /// What the consistent start changed. Nothing, where a saved motion went on.
  const StartReport& start() const { return start_; }
  /// The doubts are sentences that the user should read at the end.
  std::vector<std::string> doubts() const;
  const MarchLog& log() const { return parts_.march->log(); }  ///< what steps cost, and why some were refused

 private:
  friend class Session;
  struct Parts {
    double begin = 0;
    std::unique_ptr<TimeIntegration> integration;
    std::unique_ptr<March> march;
    EnergyBalance books;
    long grid_steps = 0;        ///< done
    VectorX gathered;           ///< by components, when the motion was written or read
    long steps = 0, saves = 0;  ///< since tangents were made anew: taken, and written to sinks (save_where_interrupted)
  };
  Motion(Session& session, const DynamicsOptions& options);
  /// Goes on. @param sink    whose part stands among the numbers; nullptr: there is none
  ///          @param report  of the last step, where it is known
  Motion(Session& session, const DynamicsOptions& options, Archive& archive, ResultSink* sink,
         const std::optional<StepRecord>& report = {});
  void show();  ///< to those who read the session
  Parts read(Archive& archive, Notes* notes);
  void write(Archive& archive, ResultSink* sink);
  static void exchange_books(Archive& archive, Parts& parts);
  void go_on(Archive& archive, ResultSink* sink);
  bool arrives(Parts anchor);
  void write_to_sinks();
  void make_march(Parts& parts, StepOptions stepping);
  StepRecord row(const MarchStep& step, const EnergyBalance& books) const;
  void record_step(const MarchStep& step, double before, const EnergyBalance& books_before);
  void save_for_sinks();
  void save_where_interrupted();
  void take_step(bool seen);
  void set_memory(int place, double value, bool smooth);
  Session& alive() const;

  Session* session_;  ///< nullptr: ended
  DynamicsOptions options_;
  double end_ = 0;
  double last_begin_ = 0;  ///< of the last step [s]; infinite where there is none
  Parts parts_;
  StartReport start_;
  PrescribedJumps prescribed_jumps_;
  std::string last_event_;
  bool anchored_ = false;      ///< sinks have the point where tangents were made anew, and steps alone have come since
  bool saved_ = false;         ///< nothing has happened since the last checkpoint
  bool last_recorded_ = true;  ///< the state is in a row
  bool last_on_grid_ = false;  ///< the last step has ended on a time of the grid
  bool cautioned_ = false;     ///< of joints that turn far in a step
};

}  // namespace bielle::mechanism
