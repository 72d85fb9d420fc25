// A process that cannot start another program, for libraries that execute commands in a file.
#pragma once

namespace bielle {

/// From this call on the kernel ends this process with SIGSYS if it tries to start another one; it may start threads.
/// The restriction cannot be removed, and a library cannot avoid it (seccomp).
/// @returns false if the system does not support it; nothing has changed then
bool forbid_other_programs();

}  // namespace bielle
