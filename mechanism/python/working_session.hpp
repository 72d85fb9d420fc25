// A session held by Python: it computes without Python's lock, one computation at a time.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

#include "mechanism/python/gate.hpp"
#include "mechanism/python/held_model.hpp"
#include "mechanism/python/interruptible.hpp"
#include "mechanism/python/recorder.hpp"
#include "mechanism/python/single_blas_thread.hpp"
#include "mechanism/python/without_lock.hpp"
#include "mechanism/session/session.hpp"

namespace bielle::python {

class WorkingSession {
 public:
  WorkingSession(HeldModel model, int threads);
  ~WorkingSession();
  WorkingSession(const WorkingSession&) = delete;
  WorkingSession& operator=(const WorkingSession&) = delete;

  const HeldModel& model() const { return model_; }
  /// Returns the session for reading, and for the operations that callbacks may use: set inputs, stop, save.
  /// @throws std::logic_error while it computes in another thread
  mechanism::Session& readable() {
    gate_->check_readable();
    return *session_;
  }
  /// Returns the session for other changes. @throws std::logic_error while it computes, also from callbacks
  mechanism::Session& idle() {
    gate_->check_idle();
    return *session_;
  }
  const std::shared_ptr<Gate>& gate() const { return gate_; }
  const std::vector<std::string>& said() const { return notes_.sentences; }
  void forget_said() { notes_.sentences.clear(); }

  /// Calls act(session) without Python's lock. @throws the exceptions of act and callbacks
  template <class Act>
  auto compute(const Callbacks& callbacks, const Act& act) {
    const Gate::Computing computing(*gate_);
    ended_.clear();
    const Listening listening(*this, callbacks);
    const SingleBlasThread one;
    const WithoutLock free;
    return act(*session_);
  }

  /// Also sends subsequent results to a recorder; a motion in progress is recorded from its next step on.
  /// @param memory  rows are kept in memory, not only written to a file
  void attach(const std::shared_ptr<Recorder>& recorder, mechanism::Recording recording, bool memory);
  /// Ends the recording, and completes its file.
  void detach(const std::shared_ptr<Recorder>& recorder);
  bool recording() const { return !recorders_.empty(); }
  /// Begins a motion, whose rows go to the recorders, if there are any.
  void open_motion(mechanism::Session& session, std::size_t expected_rows);
  void close_motion(mechanism::Session& session);
  void abandon(mechanism::Session& session);

  /// Takes a motion that Python does not need any more, while the session may be computing.
  void bury(std::unique_ptr<mechanism::Motion> motion);

 private:
  struct KeptNotes : mechanism::Notes {
    void note(const std::string& sentence) override;
    std::vector<std::string> sentences;
  };
  struct Listening {
    Listening(WorkingSession& of, const Callbacks& callbacks);
    ~Listening() { session.listener_ = nullptr; }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
    WorkingSession& session;
    Interruptible interruptible;
  };

  HeldModel model_;
  std::shared_ptr<Gate> gate_ = std::make_shared<Gate>();
  KeptNotes notes_;
  Interruptible* listener_ = nullptr;
  std::vector<std::pair<std::shared_ptr<Recorder>, mechanism::Recording>>
      recorders_;      ///< and the recording options before each
  bool open_ = false;  ///< an analysis is open, for a motion
  std::unique_ptr<mechanism::Session> session_;
  std::vector<std::unique_ptr<mechanism::Motion>> ended_;  ///< to be destroyed before the session
};

}  // namespace bielle::python
