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
  if (as_row) session_.record(state, acting, report);
  session_.gather(state, acting);
}

}  // namespace bielle::mechanism
