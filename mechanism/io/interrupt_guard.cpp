#include "mechanism/io/interrupt_guard.hpp"

#include <csignal>

#include <fmt/format.h>

#include "mechanism/session/interrupted.hpp"

namespace bielle::mechanism {
namespace {

volatile std::sig_atomic_t interrupted = 0;

/// A second interruption ends the program at once, as without a guard.
void note(int signal) {
  if (interrupted) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  interrupted = 1;
}

}  // namespace

InterruptGuard::InterruptGuard()
    : previous_int_(std::signal(SIGINT, note)),
      previous_term_(std::signal(SIGTERM, note)),
      previous_hup_(std::signal(SIGHUP, note)) {
  interrupted = 0;
  if (previous_hup_ == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup: the run must survive its terminal
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, previous_int_);
  std::signal(SIGTERM, previous_term_);
  std::signal(SIGHUP, previous_hup_);
}

bool InterruptGuard::asked() const { return interrupted != 0; }

void InterruptGuard::end_run(const std::string& place, const std::string& advice) const {
  throw Interrupted(fmt::format("interrupted {}; the results file holds all steps up to there{}", place, advice));
}

}  // namespace bielle::mechanism
