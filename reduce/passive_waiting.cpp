// Threads of OpenMP that wait for work sleep instead of spinning: on a machine that has other things to do, spinning
// threads take the processors from the one that works (4.3 s instead of 0.8 s were seen).
//
// OpenMP's library asks for OMP_WAIT_POLICY once, when it is loaded: before `main`, and before anything could be put
// into the environment (the C library sets it anew after .preinit_array). The program's own `getenv` comes before the C
// library's, for all libraries, and answers this one question. What the user says in OMP_WAIT_POLICY or GOMP_SPINCOUNT
// holds. The environment itself stays as it is.
#include <cstddef>
#include <cstring>

#include <unistd.h>

namespace {

char* value_of(const char* name) {
  if (environ == nullptr) return nullptr;
  const std::size_t length = std::strlen(name);
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (std::strncmp(*variable, name, length) == 0 && (*variable)[length] == '=') return *variable + length + 1;
  return nullptr;
}

char passive[] = "passive";

}  // namespace

extern "C" [[gnu::visibility("default"), gnu::no_sanitize("address", "undefined")]] char* getenv(
    const char* name) noexcept {
  char* const value = value_of(name);
  if (value == nullptr && std::strcmp(name, "OMP_WAIT_POLICY") == 0 && value_of("GOMP_SPINCOUNT") == nullptr)
    return passive;
  return value;
}
