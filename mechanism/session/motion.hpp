// A motion in progress: created by Session::dynamics, advanced step by step.
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

class Computation;
class Notes;
class ResultSink;
class Session;

struct DynamicsOptions {
  double duration = 0;   ///< [s] > 0
  StepOptions stepping;  ///< without break points: those of the model are added
  Scheme scheme = Scheme::generalized_alpha(0.8);
  ConstraintForm form = ConstraintForm::corrected;
  NewtonOptions newton;
  bool equilibrium = false;                       ///< whether the motion starts from static equilibrium
  std::vector<AssemblyOptions::Coordinate> held;  ///< coordinates that keep their values until equilibrium is found
};

/// The session shows the state of its motion during the lifetime of the motion, and keeps the last one. A motion ends
/// when the session starts another computation: its state can still be read, but it cannot be advanced
/// (std::logic_error).
class Motion {
 public:
  ~Motion();
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  /// Takes a step, writes the rows and checkpoints that the session's recording requests, and calls the callbacks.
  /// Fixed steps may be divided into smaller ones between two times of the grid. @returns false if no step is left
  /// @throws ComputationError as March::advance; the motion then has the state before the step
  bool step();
  /// Takes steps until the time is reached: exactly if it is on the grid of steps, otherwise it is exceeded by less
  /// than a step (`interpolated` gives the state in between). @returns false if a callback stopped the motion, or its
  /// end came first
  bool advance_to(double time);
  /// Takes steps to the end. If a stop or an exception ends the motion early, a checkpoint is written to the sinks;
  /// after a stop, the last row is written as well. @returns false if it was stopped
  bool finish();
  bool done() const { return parts_.march->done(); }
  bool stopped_by_event() const { return parts_.march->stopped(); }
  const std::string& last_event() const { return last_event_; }  ///< name of the last event; empty: there was none
  double begin() const { return parts_.begin; }                  ///< start time [s]
  double end() const { return end_; }                            ///< end time [s]
  double time() const { return state().time; }                   ///< present time [s]

  const State& state() const { return parts_.integration->state(); }
  /// @param time  time within the last step [s]. @throws InputError if it is not
  State interpolated(double time) const;
  /// Present stored energies, input and dissipation since the start [J].
  const Energy& energy() const { return parts_.energy_balance.totals(); }
  double balance() const { return parts_.energy_balance.balance(); }  ///< missing energy [J]
  const EnergyBalance& energy_balance() const { return parts_.energy_balance; }
  /// Energy removed by the scheme's own damping since the start [J].
  double scheme_loss() const { return parts_.integration->scheme_loss(); }
  /// Changes made by the consistent start. They are empty if a saved motion was continued.
  const StartReport& start() const { return start_; }
  /// Returns warnings for the end of the run.
  std::vector<std::string> warnings() const;
  const MarchLog& log() const { return parts_.march->log(); }  ///< cost of steps, and reasons of rejected ones

 private:
  friend class Session;
  struct Parts {
    double begin = 0;
    std::unique_ptr<TimeIntegration> integration;
    std::unique_ptr<March> march;
    EnergyBalance energy_balance;
    long grid_steps = 0;        ///< number of grid steps taken
    VectorX gathered;           ///< data of the step recorders, when the motion was written or read
    long steps = 0, saves = 0;  ///< steps and checkpoints since the last rebuilt tangent (save_where_interrupted)
  };
  Motion(Session& session, const DynamicsOptions& options);
  /// Continues a saved motion. @param sink    sink whose part is among the numbers; nullptr: there is none
  ///          @param report  report of the last step, if it is known
  Motion(Session& session, const DynamicsOptions& options, Archive& archive, ResultSink* sink,
         const std::optional<StepRecord>& report = {});
  void show();             ///< makes the session show this motion
  void end_computation();  ///< the session no longer refers to this motion
  Parts read(Archive& archive, Notes* notes);
  void write(Archive& archive, ResultSink* sink);
  static void exchange_energy_balance(Archive& archive, Parts& parts);
  void go_on(Archive& archive, ResultSink* sink);
  bool arrives(Parts anchor);
  void write_to_sinks();
  void make_march(Parts& parts, StepOptions stepping);
  StepRecord row(const MarchStep& step, const EnergyBalance& energy_balance) const;
  void record_step(const MarchStep& step, double before, const EnergyBalance& balance_before);
  void save_for_sinks();
  void save_where_interrupted();
  void take_step(bool seen);
  void set_memory(int place, double value, bool smooth);
  Session& alive() const;

  Session& session_;
  std::unique_ptr<Computation> computation_;  ///< none after the motion has ended
  DynamicsOptions options_;
  double end_ = 0;
  double last_begin_ = 0;  ///< start of the last step [s]; infinite if there is none
  Parts parts_;
  StartReport start_;
  PrescribedJumps prescribed_jumps_;
  std::string last_event_;
  bool anchored_ = false;      ///< sinks have the checkpoint at which tangents were rebuilt, and only steps followed it
  bool saved_ = false;         ///< nothing has changed since the last checkpoint
  bool last_recorded_ = true;  ///< whether the last state has been recorded
  bool last_on_grid_ = false;  ///< the last step ended on a time of the grid
  bool cautioned_ = false;     ///< a warning about large rotations of joints in a step was given
};

}  // namespace bielle::mechanism
