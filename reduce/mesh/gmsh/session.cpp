#include "reduce/mesh/gmsh/session.hpp"

#include <cstdio>
#include <iostream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <gmsh.h>
#include <unistd.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

std::mutex& gmsh_mutex() {
  static std::mutex mutex;
  return mutex;
}

// Redirects the file descriptor of standard output to /dev/null: OpenCASCADE writes to std::cout and to stdout.
class SilentStandardOutput {
 public:
  SilentStandardOutput() {
    flush();
    saved_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (saved_ >= 0 && nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
    if (nowhere >= 0) close(nowhere);
  }
  ~SilentStandardOutput() {
    flush();
    if (saved_ < 0) return;
    dup2(saved_, STDOUT_FILENO);
    close(saved_);
  }
  SilentStandardOutput(const SilentStandardOutput&) = delete;
  SilentStandardOutput& operator=(const SilentStandardOutput&) = delete;

 private:
  static void flush() {
    std::cout.flush();
    std::fflush(stdout);
  }
  int saved_ = -1;
};

// The errors that gmsh has logged since the log was started, without their label.
std::string logged_errors() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::string errors;
  const std::string label = "Error: ";
  for (const std::string& line : log)
    if (line.compare(0, label.size(), label) == 0) errors += (errors.empty() ? "" : "; ") + line.substr(label.size());
  return errors;
}

// Calls `work`. Returns gmsh's reason (": ...", or empty if unknown) if it throws an exception of its own; exceptions
// of Bielle pass through.
std::optional<std::string> failure(const std::function<void()>& work) {
  std::string reason;
  try {
    work();
    return {};
  } catch (const std::length_error&) {  // gmsh allocates memory by the numbers of a damaged file
    reason = "a number of its items is too large";
  } catch (const std::exception&) {
    throw;
  } catch (const std::string& thrown) {
    reason = thrown;
  } catch (...) {  // numbers, and OpenCASCADE's own failures
  }
  const std::string errors = logged_errors();
  if (!errors.empty()) reason = errors;
  return reason.empty() ? reason : ": " + reason;
}

}  // namespace

struct GmshSession::State {
  std::unique_lock<std::mutex> lock{gmsh_mutex()};
  SilentStandardOutput silence;
};

GmshSession::GmshSession() : state_(std::make_unique<State>()) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);  // with more, the same geometry gives another mesh each time
  gmsh::logger::start();
}

GmshSession::~GmshSession() {
  try {
    gmsh::logger::stop();
    gmsh::finalize();
  } catch (...) {  // a destructor must not throw, and nothing can be done about the error
  }
}

void GmshSession::read(const std::string& what, const std::function<void()>& work) {
  if (const auto reason = failure(work)) throw InputError(what + *reason);
}

void GmshSession::compute(const std::string& what, const std::function<void()>& work) {
  if (const auto reason = failure(work)) throw ComputationError(what + *reason);
}

}  // namespace bielle::reduce
