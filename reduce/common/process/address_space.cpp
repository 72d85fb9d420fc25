#include "reduce/common/process/address_space.hpp"

#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

namespace bielle {

[[gnu::no_sanitize("address", "undefined")]] rlim_t address_space() {
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  char text[32] = {};
  const ssize_t count = file < 0 ? 0 : read(file, text, sizeof text - 1);
  if (file >= 0) close(file);
  return count <= 0 ? 0 : static_cast<rlim_t>(std::atol(text)) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace bielle
