// A session as Python holds it: computes without Python's lock, one thing at a time.
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
  /// To be read, and for what callbacks may do: set inputs, stop, save.
  /// @throws std::logic_error while it computes in another thread
  mechanism::Session& readable() {
    gate_->check_readable();
    return *session_;
  }
  /// To be changed otherwise. @throws std::logic_error while it computes, also from callbacks
  mechanism::Session& idle() {
    gate_->check_idle();
    return *session_;
  }
  const std::shared_ptr<Gate>& gate() const { return gate_; }
  const std::vector<std::string>& said() const { return notes_.sentences; }
  void forget_said() { notes_.sentences.clear(); }

  /// Calls act(session) without Python's lock. @throws what act and callbacks throw
  template <class Act>
  auto compute(const Callbacks& callbacks, const Act& act) {
    const Gate::Computing computing(*gate_);
    ended_.clear();
    const Listening listening(*this, callbacks);
    const SingleBlasThread one;
    const WithoutLock free;
    return act(*session_);
  }

  /// Sends what follows to a recorder as well; a motion under way is recorded from its next step on.
  /// @param memory  rows are kept there, not only written to a file
  void attach(const std::shared_ptr<Recorder>& recorder, mechanism::Recording recording, bool memory);
  /// Ends what is being recorded, and a file as complete.
  void detach(const std::shared_ptr<Recorder>& recorder);
  bool recording() const { return !recorders_.empty(); }
  /// A motion begins, whose rows go to the recorders, if any.
  void open_motion(mechanism::Session& session, std::size_t expected_rows);
  void close_motion(mechanism::Session& session);
  void abandon(mechanism::Session& session);

  /// Takes a motion that Python has no use for while the session may be computing.
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
      recorders_;      ///< and the recording before each
  bool open_ = false;  ///< an analysis, for a motion
  std::unique_ptr<mechanism::Session> session_;
  std::vector<std::unique_ptr<mechanism::Motion>> ended_;  ///< to be destroyed before the session
};

}  // namespace bielle::python
