// The amount of memory that the process may still allocate.
#pragma once

namespace bielle {

/// Returns the memory that the process may still allocate [MB = 1e6 bytes]. It is the smaller of the memory left on the
/// machine (Linux: MemAvailable and free swap) and that left below a limit of the address space (`ulimit -v`), plus the
/// memory that the process has freed and malloc has kept. It is infinite if neither limit is known. Limits of
/// containers are not taken into account.
double free_memory_MB();

}  // namespace bielle
