// What surrounds the work of a program: its exit status, its standard streams, the memory that it may have.
#pragma once

#include <string>

namespace bielle {

/// Runs a program's body and turns its outcome into the contract's exit status: 0, 1 (InputError), 2 (ComputationError
/// and everything unforeseen, output that cannot be written included). Prints one line `<program>: error: <message>` on
/// standard error.
///
/// Standard streams that are closed are opened to nowhere, so that no results file gets their numbers; a reader of
/// standard error that goes away ends no run.
int run_program(const std::string& program, int (*body)(int argc, char** argv), int argc, char** argv);

}  // namespace bielle
