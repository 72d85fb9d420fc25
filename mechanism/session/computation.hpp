// A computation at work on a session: it changes the session's state, shows the states that it finds one after the
// other, and records them.
#pragma once

#include <string>

#include "mechanism/session/session.hpp"

namespace bielle::mechanism {

class Computation {
 public:
  /// Ends a motion, if any, and forgets a wish to stop.
  explicit Computation(Session& session);
  ~Computation();  ///< the session shows its own state again
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;

  State& state() { return session_.state_; }     ///< the session's, with which it goes on
  Loaded& loaded() { return session_.loaded_; }  ///< what of loads and motions has been made
  bool started() const { return session_.started_; }
  void set_started() { session_.started_ = true; }  ///< the state is no longer the drawing
  void set_acting(const Environment& acting) { session_.acting_ = acting; }

  /// The session is read at this state, which has to outlive that, until the next one.
  /// @param acting  under which it stands
  /// @param as_row  whether it is a row of the results
  void show(const State& state, const Environment& acting, const StepRecord& report, bool as_row);
  const State& shown() const { return *session_.shown_; }
  void progress(double done, const std::string& at) const;  ///< @param done  part of all, 0..1
  void note(const std::string& sentence) const { session_.note(sentence); }
  void note(const Event& event) { session_.note(event); }

 private:
  Session& session_;
};

}  // namespace bielle::mechanism
