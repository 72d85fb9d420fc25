#include "mechanism/io/interrupt_guard.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

#include <fmt/format.h>

#include "mechanism/session/interrupted.hpp"

namespace bielle::mechanism {
namespace {

/// One interruption may arrive twice within this time: `timeout` sends its signal to the program and to its group, and
/// a closed terminal sends it to the shell and to its programs.
constexpr std::int64_t one_interruption = 500'000'000;  // [ns]

volatile std::sig_atomic_t interrupted = 0;
std::atomic<std::int64_t> first_interruption = 0;  // time of the first interruption [ns]
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "signal handlers may not wait");

std::int64_t monotonic_time() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);  // may be called by signal handlers
  return std::int64_t{1'000'000'000} * time.tv_sec + time.tv_nsec;
}

/// Records the first interruption. A later one ends the program at once, as without a guard.
void note(int signal) {
  if (!interrupted) {
    first_interruption = monotonic_time();
    interrupted = 1;
  } else if (monotonic_time() - first_interruption > one_interruption) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
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
