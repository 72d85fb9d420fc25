#include "reduce/common/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "reduce/common/error.hpp"

namespace bielle {

namespace {

using Clock = std::chrono::steady_clock;
constexpr double seconds_between_frames = 0.1, seconds_between_lines = 5;
constexpr int bar_width = 24;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Prints a text. It never throws, because the work must go on even if its progress cannot be shown.
void say(const std::string& text) { std::fputs(text.c_str(), stderr); }

std::string duration(double seconds) {
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

Progress::Progress(bool quiet, Locator located)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), located_(std::move(located)) {}

Progress::~Progress() {
  // An exception may be in flight: end the line that is being redrawn, so that the message starts on a new one.
  if (running_ && terminal_ && !quiet_) std::fputc('\n', stderr);
}

void Progress::start(const std::string& phase) {
  finish();
  running_ = true;
  phase_ = phase;
  detail_.clear();
  fraction_ = 0;
  phase_start_ = last_draw_ = Clock::now();
  if (quiet_) return;
  if (terminal_)
    draw(false);
  else
    say(phase_ + " ...\n");
}

bool Progress::due() const {
  return running_ && !quiet_ &&
         seconds_since(last_draw_) >= (terminal_ ? seconds_between_frames : seconds_between_lines);
}

void Progress::update(double fraction, const std::string& detail) {
  if (!due()) return;
  fraction_ = std::clamp(fraction, 0.0, 1.0);
  detail_ = detail;
  last_draw_ = Clock::now();
  draw(false);
}

void Progress::finish() {
  if (!running_) return;
  running_ = false;
  phases_.push_back({phase_, seconds_since(phase_start_), peak_memory_MB()});
  if (!quiet_) draw(true);
}

Progress Progress::of_part(const std::string& name) const {
  Progress part(true, located_);
  part.part_ = name;
  return part;
}

void Progress::warn(const std::string& message) { show_warning(with_subject(part_, message)); }

void Progress::show_warning(const std::string& text) {
  if (running_ && terminal_ && !quiet_) say("\r\033[K");
  say("warning: " + text + "\n");
}

void Progress::warn(const std::string& subject, const std::string& message, Subject is) {
  const std::string text = with_subject(part_, with_subject(subject, message, is));
  show_warning(located_ ? located_(subject, text) : text);
}

void Progress::note(const std::string& message) {
  if (quiet_) return;
  if (running_ && terminal_) say("\r\033[K");
  say(message + "\n");
}

void Progress::adopt(std::vector<PhaseReport> phases) {
  running_ = false;
  phases_ = std::move(phases);
}

void Progress::draw(bool end) {
  const double elapsed = seconds_since(phase_start_);
  const std::string detail = detail_.empty() ? "" : ", " + detail_;
  if (end) {
    say(fmt::format("{}{}: {}\n", terminal_ ? "\r\033[K" : "", phase_, duration(elapsed)));
  } else {
    const std::string left =
        fraction_ > 0 ? fmt::format(", {} left", duration(elapsed * (1 - fraction_) / fraction_)) : "";
    const std::string percent = fmt::format("{:.0f} %", 100 * fraction_);
    if (terminal_) {
      const int full = static_cast<int>(std::lround(bar_width * fraction_));
      say(fmt::format("\r\033[K{} [{:#<{}}{:.<{}}] {}{}{}", phase_, "", full, "", bar_width - full, percent, left,
                      detail));
    } else {
      say(fmt::format("{}: {}{}{}\n", phase_, percent, left, detail));
    }
  }
  std::fflush(stderr);
}

double peak_memory_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in kB
}

}  // namespace bielle
