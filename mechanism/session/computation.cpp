#include "mechanism/session/computation.hpp"

namespace bielle::mechanism {

Computation::Computation(Session& session) : session_(session) {
  session_.at_rest();
  session_.stopping_ = false;
}

Computation::~Computation() { session_.shown_ = &session_.state_; }

void Computation::show(const State& state, const Environment& acting, const StepRecord& report, bool as_row) {
  session_.shown_ = &state;
  session_.acting_ = acting;
  session_.report_ = report;
  if (as_row) session_.recorder().record(state, acting, report);
  session_.recorder().gather(state, acting);
}

void Computation::show(Motion& motion) {
  session_.motion_ = &motion;
  session_.started_ = true;
  session_.shown_ = &motion.state();
  session_.loaded_ = {1, 1};
  session_.acting_ = session_.environment_;
}

void Computation::note(const std::string& sentence) const {
  if (session_.notes_) session_.notes_->note(sentence);
}

void Computation::note(const Event& event) {
  for (const auto& callback : session_.on_event_) callback(event);
  session_.recorder().note(event);
}

void Computation::note(const Attempt& attempt) {
  for (const auto& callback : session_.on_attempt_) callback(attempt);
}

}  // namespace bielle::mechanism
