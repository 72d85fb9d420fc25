#include "reduce/common/files/atomic_output.hpp"

#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "reduce/common/error.hpp"

namespace bielle {

namespace {

constexpr int most_at_a_time = 100;

/// Locks a file for as long as the descriptor is open; HDF5's own locks are of another kind.
/// @returns false if another run holds the lock; true if the file system supports no locks
bool lock(int file) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(file, F_OFD_SETLK, &whole) == 0 || (errno != EAGAIN && errno != EACCES);
}

/// Tells whether the name still belongs to the open file: another run may have renamed it in the meantime.
bool has_name(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

AtomicOutput::AtomicOutput(std::string path) : path_(std::move(path)) {
  for (int k = 1; k <= most_at_a_time; ++k) {
    temporary_path_ = k == 1 ? path_ + ".partial" : fmt::format("{}.{}.partial", path_, k);
    lock_ = open(temporary_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0) return;  // the later write reports the reason
    if (lock(lock_) && has_name(lock_, temporary_path_)) return;
    close(lock_);
  }
  lock_ = -1;
  throw ComputationError(fmt::format("{}: more than {} runs are writing it", path_, most_at_a_time));
}

AtomicOutput::~AtomicOutput() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_path_, ignored);
  if (lock_ >= 0) close(lock_);
}

void AtomicOutput::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_path_, path_, error);
  if (error)
    throw ComputationError(
        fmt::format("{}: cannot take its name from '{}': {}", path_, temporary_path_, error.message()));
  committed_ = true;
}

}  // namespace bielle
