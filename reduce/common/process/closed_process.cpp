#include "reduce/common/process/closed_process.hpp"

#include <cerrno>
#include <cstddef>
#include <iterator>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace bielle {

#if defined(__x86_64__)

bool forbid_other_programs() {
  constexpr unsigned other_tables = 0x40000000;  // system calls of the x32 ABI
  constexpr auto load = [](std::size_t offset) {
    return sock_filter{BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<unsigned>(offset)};
  };
  constexpr auto skip_unless = [](unsigned comparison, unsigned value) {  // the next instruction
    return sock_filter{static_cast<unsigned short>(BPF_JMP | comparison | BPF_K), 0, 1, value};
  };
  constexpr auto answer = [](unsigned verdict) { return sock_filter{BPF_RET | BPF_K, 0, 0, verdict}; };
  constexpr unsigned end = SECCOMP_RET_KILL_PROCESS;
  // Filters cannot read the flags of clone3; the filter therefore refuses it, and the C library uses clone.
  sock_filter filter[] = {
      load(offsetof(seccomp_data, arch)),
      {BPF_JMP | BPF_JEQ | BPF_K, 1, 0, AUDIT_ARCH_X86_64},
      answer(end),
      load(offsetof(seccomp_data, nr)),
      skip_unless(BPF_JGE, other_tables),
      answer(end),
      skip_unless(BPF_JEQ, SYS_fork),
      answer(end),
      skip_unless(BPF_JEQ, SYS_vfork),
      answer(end),
      skip_unless(BPF_JEQ, SYS_execve),
      answer(end),
      skip_unless(BPF_JEQ, SYS_execveat),
      answer(end),
      skip_unless(BPF_JEQ, SYS_clone3),
      answer(SECCOMP_RET_ERRNO | ENOSYS),
      {BPF_JMP | BPF_JEQ | BPF_K, 1, 0, SYS_clone},
      answer(SECCOMP_RET_ALLOW),
      load(offsetof(seccomp_data, args)),  // the flags; the lower half comes first
      skip_unless(BPF_JSET, CLONE_THREAD),
      answer(SECCOMP_RET_ALLOW),
      answer(end),
  };
  const sock_fprog program{static_cast<unsigned short>(std::size(filter)), filter};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
}

#else

bool forbid_other_programs() { return false; }

#endif

}  // namespace bielle
