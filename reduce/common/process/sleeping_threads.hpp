// Threads of OpenMP that wait for work sleep instead of spinning: on a machine that has other things to do, spinning
// threads take the processors from the one that works (4.3 s instead of 0.8 s were seen).
#pragma once

namespace bielle {

/// OpenMP's library reads OMP_WAIT_POLICY when it is loaded, before `main`. Unless that or GOMP_SPINCOUNT is set, this
/// sets it to passive and executes the program once more; otherwise it returns at once.
void let_waiting_threads_sleep(char** argv);

}  // namespace bielle
