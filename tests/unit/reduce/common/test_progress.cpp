#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include "reduce/common/progress.hpp"

using bielle::Progress;
using Catch::Matchers::Contains;

namespace {

void work(Progress& progress) {
  progress.start("factorisation");
  for (int i = 0; i <= 10; ++i) {
    progress.update(0.1 * i, "step " + std::to_string(i));
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
  progress.note("a note");
  progress.warn("beware");
  progress.start("modes");
  progress.finish();
}

/// Returns the output of `action` on standard error, which is a terminal or a pipe.
std::string printed(bool terminal, const std::function<void()>& action) {
  int ours = -1, theirs = -1, ends[2];
  if (terminal) {
    REQUIRE(openpty(&ours, &theirs, nullptr, nullptr, nullptr) == 0);
  } else {
    REQUIRE(pipe(ends) == 0);
    ours = ends[0];
    theirs = ends[1];
  }
  const pid_t child = fork();
  if (child == 0) {
    dup2(theirs, STDERR_FILENO);
    action();
    fflush(stderr);
    _exit(0);
  }
  close(theirs);
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(ours, buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(n));
  close(ours);
  waitpid(child, nullptr, 0);
  return text;
}

std::string printed_by_work(bool terminal, bool quiet) {
  return printed(terminal, [quiet] {
    Progress progress(quiet);
    work(progress);
  });
}

}  // namespace

TEST_CASE("Off a terminal, phases print plain lines") {
  const std::string text = printed_by_work(false, false);
  CHECK_THAT(text, Contains("factorisation ...\n") && Contains("\nfactorisation: 0.") && Contains("modes: 0.0 s\n"));
  CHECK_THAT(text, Contains("a note\n") && Contains("warning: beware\n"));
  CHECK(text.find('\r') == std::string::npos);
  CHECK(text.find('%') == std::string::npos);  // a short phase prints nothing between its start and its end
}

TEST_CASE("On a terminal, a phase is one line that is redrawn, with the time left") {
  const std::string text = printed_by_work(true, false);
  CHECK_THAT(text, Contains("\r\033[Kfactorisation [") && Contains(" s left, step ") && Contains("modes: 0.0 s\r\n"));
  std::size_t frames = 0;
  for (std::size_t at = text.find('%'); at != std::string::npos; at = text.find('%', at + 1)) ++frames;
  CHECK(frames >= 2);
  CHECK(frames <= 6);  // lines in 0.33 s at ten a second, and the first of each phase
}

TEST_CASE("A quiet run prints warnings only") { CHECK(printed_by_work(false, true) == "warning: beware\n"); }

TEST_CASE("A warning about a key begins with the key, and with its place if this is known") {
  const auto printed_with = [](const Progress::Locator& located) {
    return printed(false, [&] {
      Progress progress(true, located);
      progress.warn("mesh", "coarse");
      progress.warn("damping", "weak", bielle::Subject::hidden);
      progress.warn("", "plain");
      progress.warn("beware");
    });
  };
  CHECK(printed_with({}) == "warning: mesh: coarse\nwarning: weak\nwarning: plain\nwarning: beware\n");
  const auto located = [](const std::string& subject, const std::string& message) {
    return "<" + subject + "> " + message;
  };
  CHECK(printed_with(located) ==
        "warning: <mesh> mesh: coarse\nwarning: <damping> weak\nwarning: <> plain\nwarning: beware\n");
}

TEST_CASE("Warnings of a part of the work begin with its name, and its progress is not shown") {
  CHECK(printed(false, [] {
          const auto located = [](const std::string& subject, const std::string& message) {
            return "<" + subject + "> " + message;
          };
          const Progress whole(true, located);
          Progress part = whole.of_part("bar.2");
          part.start("modes");
          part.note("many");
          part.warn("mesh", "coarse");
          part.warn("beware");
          part.finish();
        }) == "warning: <mesh> bar.2: mesh: coarse\nwarning: bar.2: beware\n");
}

TEST_CASE("An exception ends the line of the progress bar, so that its message starts on a new line") {
  const std::string text = printed(true, [] {
    try {
      Progress progress;
      progress.start("modes");
      throw 1;
    } catch (int) {
      fputs("message", stderr);
    }
  });
  CHECK_THAT(text, Contains("\r\nmessage"));
}

TEST_CASE("Time and memory of each phase are recorded") {
  Progress progress(true);
  progress.update(0.5);  // no phase runs: nothing happens
  work(progress);
  REQUIRE(progress.phases().size() == 2);
  CHECK(progress.phases()[0].name == "factorisation");
  CHECK(progress.phases()[0].seconds >= 0.33);
  CHECK(progress.phases()[1].seconds < progress.phases()[0].seconds);
  CHECK(progress.phases()[1].peak_memory_MB > 1);
  CHECK(bielle::peak_memory_MB() < 1e6);
}
