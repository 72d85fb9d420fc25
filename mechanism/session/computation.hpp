// A computation that works on a session: it changes the session's state, shows the states that it finds one after the
// other, and records them.
#pragma once

#include <string>

#include "mechanism/session/session.hpp"

namespace bielle::mechanism {

class Computation {
 public:
  /// Ends a motion, if any, and clears a request to stop.
  explicit Computation(Session& session);
  ~Computation();  ///< the session shows its own state again
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;

  State& state() { return session_.state_; }     ///< state of the session, which the computation changes
  Loaded& loaded() { return session_.loaded_; }  ///< fractions of loads and motions applied so far
  bool started() const { return session_.started_; }
  void set_started() { session_.started_ = true; }  ///< the state is no longer that of the model file
  void set_acting(const Environment& acting) { session_.acting_ = acting; }
  void set_report(const StepRecord& report) { session_.report_ = report; }

  /// Makes this state the one that reads of the session refer to, until the next call; the state must live until then.
  /// @param acting  environment of the state
  /// @param as_row  whether it is a row of the results
  void show(const State& state, const Environment& acting, const StepRecord& report, bool as_row);
  /// Makes a motion the one that the session shows and can set, save and end; loads and prescribed motions act fully.
  void show(Motion& motion);
  void end_motion() { session_.at_rest(); }  ///< ends the motion that is shown, and this computation with it
  const State& shown() const { return *session_.shown_; }

  void note(const std::string& sentence) const;
  void note(const Event& event);      ///< tells the callbacks and the sinks
  void note(const Attempt& attempt);  ///< tells the callbacks

 private:
  Session& session_;
};

}  // namespace bielle::mechanism
