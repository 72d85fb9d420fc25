// The frame of a program: its exit status, its standard streams, its memory limit.
#pragma once

#include <string>

namespace bielle {

/// Runs a program's body and converts its outcome to the exit status: 0, 1 (InputError), 2 (ComputationError and all
/// unexpected errors, also output that cannot be written). Prints one line `<program>: error: <message>` on standard
/// error; on a terminal a second one names the explanation of the message (`--explain`), if there is one.
///
/// Closed standard streams are opened to /dev/null, so that no results file gets their descriptors; a run continues if
/// the reader of standard error closes it.
int run_program(const std::string& program, int (*body)(int argc, char** argv), int argc, char** argv);

}  // namespace bielle
