#include "reduce/distributed/ranks/driver.hpp"

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

pid_t driver = -1;

}  // namespace

std::unique_ptr<Channel> start_driver(int argc, char** argv) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "bielle-reduce";
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw ComputationError(fmt::format("no connection to bielle-reduce: {}", std::strerror(errno)));
  const int inherited = dup(ends[1]);  // without close-on-exec
  close(ends[1]);
  std::string path = program.string(), option = fmt::format("--ranks-at={}", inherited);
  std::vector<char*> arguments{path.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  arguments.push_back(option.data());
  arguments.push_back(nullptr);
  const int failed = posix_spawn(&driver, path.c_str(), nullptr, nullptr, arguments.data(), environ);
  close(inherited);
  if (failed != 0) {
    close(ends[0]);
    throw ComputationError(fmt::format("{} cannot be started: {}", path, std::strerror(failed)));
  }
  return std::make_unique<Channel>(ends[0], "bielle-reduce");
}

int driver_status() {
  int status = 0;
  while (waitpid(driver, &status, 0) < 0)
    if (errno != EINTR) return 2;
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  fmt::print(stderr, "bielle-reduce-mpi: error: bielle-reduce was ended by signal {} ({})\n", WTERMSIG(status),
             strsignal(WTERMSIG(status)));
  return 2;
}

}  // namespace bielle::reduce
