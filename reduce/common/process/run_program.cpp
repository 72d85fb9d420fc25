#include "reduce/common/process/run_program.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include "reduce/common/error.hpp"
#include "reduce/common/explanations.hpp"
#include "reduce/common/process/address_space.hpp"

namespace bielle {

namespace {

// -- code that runs before the libraries are initialised, those of the sanitizers included

constexpr rlim_t other_libraries = rlim_t{64} << 20;

[[gnu::no_sanitize("address", "undefined")]] rlim_t blas_threads() {
  for (const char* name : {"OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS"})
    if (const char* text = std::getenv(name); text != nullptr && std::atoi(text) > 0)
      return static_cast<rlim_t>(std::atoi(text));
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? static_cast<rlim_t>(CPU_COUNT(&set)) : 1;
}

[[gnu::no_sanitize("address", "undefined")]] void check_address_space(int, char**, char**) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  if (limit.rlim_cur >= address_space() + blas_threads() * blas_buffer + other_libraries) return;
  constexpr char sentence[] =
      "error: out of memory: the limit of the address space (ulimit -v) leaves none to work with\n";
  static_cast<void>(!write(STDERR_FILENO, sentence, sizeof sentence - 1));
  _exit(2);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const before_the_libraries)(int, char**,
                                                                                 char**) = check_address_space;

// -- the standard streams

/// Opens the standard streams that are closed: the next opened file would get the number of one, and printed text would
/// be written into it.
void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) static_cast<void>(!open("/dev/null", O_RDWR));
}

std::string output_fault(bool closed) {
  return closed ? "standard output was closed before all was printed"
                : "standard output cannot be written; is the disk full?";
}

void finish_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw ComputationError(output_fault(errno == EPIPE));
}

/// Returns a line that leads from a message to its explanation, if there is one. Only a reader at a terminal gets it:
/// scripts find one line for each error.
std::string hint(const std::string& program, const std::string& message) {
  if (isatty(STDERR_FILENO) == 0) return "";
  const std::vector<Explanation> explanations = read_explanations(explanation_pages());
  const Explanation* found = explanation_of(explanations, message);
  return found == nullptr ? "" : fmt::format("{} --explain {} says more\n", program, found->name);
}

}  // namespace

int run_program(const std::string& program, int (*body)(int argc, char** argv), int argc, char** argv) {
  const auto report = [&](const std::string& message, int status) {
    std::fputs(fmt::format("{}: error: {}\n{}", program, message, hint(program, message)).c_str(), stderr);
    return status;
  };
  open_closed_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond the user's limit is an error like a full disk
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const int status = body(argc, argv);
    finish_standard_output();
    return status;
  } catch (const InputError& error) {
    return report(error.what(), 1);
  } catch (const ComputationError& error) {
    return report(error.what(), 2);
  } catch (const std::bad_alloc&) {
    return report("out of memory", 2);
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again)
      return report("out of memory: no further thread can be started", 2);
    if (std::ferror(stdout) != 0) return report(output_fault(error.code() == std::errc::broken_pipe), 2);
    return report(std::string("unforeseen failure: ") + error.what(), 2);
  } catch (const std::exception& error) {
    return report(std::string("unforeseen failure: ") + error.what(), 2);
  } catch (...) {
    return report("unforeseen failure of unknown kind", 2);
  }
}

}  // namespace bielle
