// The amount of memory that the process may still allocate.
#pragma once

namespace bielle {

/// The smaller of the free memory of the machine (Linux: MemAvailable and free swap) and the rest of a limit of the
/// address space (`ulimit -v`) [MB = 1e6 bytes]; infinite if neither is known. Limits of containers are not taken into
/// account.
double free_memory_MB();

}  // namespace bielle
