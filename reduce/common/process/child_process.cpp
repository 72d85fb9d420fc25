#include "reduce/common/process/child_process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "reduce/common/error.hpp"
#include "reduce/common/process/address_space.hpp"

namespace bielle {

namespace {

/// Outcome of the work.
enum Outcome : std::uint64_t { value = 'v', input = 'i', computation = 'c', memory = 'm', unforeseen = 'u' };

void write_all(int target, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(target, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // the parent is gone
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

std::string read_all(int source) {
  std::string text;
  char buffer[1 << 16];
  while (true) {
    const ssize_t count = read(source, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

/// Begins an answer; the subject of a failure and the text follow.
struct Head {
  std::uint64_t outcome, subject_size, text_size;
};

void send(int pipe, Outcome outcome, const std::string& text, const std::string& subject = "") {
  const Head head{outcome, subject.size(), text.size()};
  write_all(pipe, reinterpret_cast<const char*>(&head), sizeof head);
  write_all(pipe, subject.data(), subject.size());
  write_all(pipe, text.data(), text.size());
}

/// Redirects file descriptor 2 to /dev/null, on which the C library and others report a crash; the program's own
/// messages still go to standard error.
void divert_last_words() {
  const int shown = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, STDERR_FILENO);
  std::FILE* const own = shown < 0 ? nullptr : fdopen(shown, "w");
  if (own == nullptr) return;
  std::setvbuf(own, nullptr, _IONBF, 0);
  stderr = own;
}

/// Lowers a limit of this process to `most`.
void lower(decltype(RLIMIT_CPU) kind, rlim_t most) {
  rlimit limit{};
  getrlimit(kind, &limit);
  if (limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur > most) limit.rlim_cur = most;
  setrlimit(kind, &limit);
}

void set_limits(const ChildLimits& limits) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (limits.seconds > 0) lower(RLIMIT_CPU, static_cast<rlim_t>(limits.seconds));
  if (limits.memory > 0) lower(RLIMIT_AS, address_space() + limits.memory);
}

[[noreturn]] void run_child(int pipe, pid_t parent, const ChildLimits& limits,
                            const std::function<std::string()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  std::signal(SIGPIPE, SIG_IGN);
  set_limits(limits);
  divert_last_words();
  try {
    send(pipe, value, work());
  } catch (const InputError& error) {
    send(pipe, input, error.what(), error.subject());
  } catch (const ComputationError& error) {
    send(pipe, computation, error.what(), error.subject());
  } catch (const std::bad_alloc&) {
    send(pipe, memory, "");
  } catch (const std::exception& error) {
    send(pipe, unforeseen, error.what());
  } catch (...) {
    send(pipe, unforeseen, "unknown kind");
  }
  _exit(0);  // buffers and files that are shared with the parent are not flushed or closed a second time
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// @param status  the status from `waitpid`
const std::string& sentence_of(const ChildLoss& lost, int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS) return lost.forbidden;
  return WIFEXITED(status) ? lost.ended : lost.crashed;
}

}  // namespace

std::string in_child_process(const ChildLoss& lost, const ChildLimits& limits,
                             const std::function<std::string()>& work) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw ComputationError(fmt::format("no pipe can be made: {}", std::strerror(errno)));
  std::fflush(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    run_child(ends[1], parent, limits, work);
  }
  const int failed = errno;
  close(ends[1]);
  const std::string answer = child < 0 ? "" : read_all(ends[0]);
  close(ends[0]);
  if (child < 0) throw ComputationError(fmt::format("no process can be started: {}", std::strerror(failed)));
  const int status = wait_for(child);
  Head head{};
  if (answer.size() >= sizeof head) std::memcpy(&head, answer.data(), sizeof head);
  if (answer.size() < sizeof head || answer.size() - sizeof head != head.subject_size + head.text_size)
    throw InputError(lost.subject, sentence_of(lost, status));
  const std::string subject = answer.substr(sizeof head, head.subject_size);
  std::string text = answer.substr(sizeof head + head.subject_size);
  switch (head.outcome) {
    case value:
      return text;
    case input:
      throw InputError(subject, text, Subject::hidden);  // the text contains the subject already
    case computation:
      throw ComputationError(subject, text, Subject::hidden);
    case memory:
      throw std::bad_alloc();
    default:
      throw std::runtime_error(text);
  }
}

}  // namespace bielle
