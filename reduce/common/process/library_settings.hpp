// Settings that libraries read from the environment before `main`.
#pragma once

namespace bielle {

/// Sets, unless they are set already:
///   OMP_WAIT_POLICY=passive (or a GOMP_SPINCOUNT)  OpenMP's threads sleep while they wait for work. On a machine that
///       has other work, spinning threads take the processors from the one that works (4.3 s instead of 0.8 s).
///   GLIBC_TUNABLES  malloc asks for huge pages and keeps the memory that is freed. The first use of a page costs: a
///       reduction with 95,000 unknowns took two thirds of the processor time (11 s instead of 16 s, on a virtual
///       machine), with the same memory.
/// Then it executes the program once more. It returns if nothing is to be set, or if the program cannot be executed.
void apply_library_settings(char** argv);

/// Lets malloc keep the memory that is freed, for programs that do not call `apply_library_settings`: matrices that are
/// made anew at each step would otherwise be new pages each time.
void keep_freed_memory();

}  // namespace bielle
