// Makes waiting OpenMP threads sleep instead of spin: on a busy machine, spinning threads take the processors from the
// working one (4.3 s instead of 0.8 s were measured).
#pragma once

namespace bielle {

/// OpenMP's library reads OMP_WAIT_POLICY when it is loaded, before `main`. If neither that nor GOMP_SPINCOUNT is set,
/// this function sets it to passive and executes the program once more; otherwise it returns at once.
void let_waiting_threads_sleep(char** argv);

}  // namespace bielle
