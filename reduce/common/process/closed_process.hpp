// A process that cannot start another program: for libraries that run what a file says.
#pragma once

namespace bielle {

/// From now on the kernel ends this process with SIGSYS when it tries to start another one; threads may be started.
/// Nothing undoes it, and a library cannot get around it (seccomp).
/// @returns false where the system has no such protection: nothing has changed
bool forbid_other_programs();

}  // namespace bielle
