// The amount of memory that the process may still allocate.
#pragma once

namespace bielle {

/// The less of what the machine has left (Linux: MemAvailable and free swap) and what a limit of the address space
/// (`ulimit -v`) leaves, and what the process has freed and kept [MB = 1e6 bytes]; infinite where neither is known.
/// Limits of containers are not seen.
double free_memory_MB();

}  // namespace bielle
