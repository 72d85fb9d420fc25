// The process bielle-reduce that rank 0 starts: it reads the body file, reduces, checks and writes as usual, and leaves
// the large matrices to the ranks. It is a process of its own, since PETSc brings another HDF5 than the one with which
// superelements are written.
#pragma once

#include <memory>

#include "reduce/distributed/channel.hpp"

namespace bielle::reduce {

/// Starts the bielle-reduce next to this program with its arguments. @throws ComputationError when it is not there
std::unique_ptr<Channel> start_driver(int argc, char** argv);

/// Waits until it ends. @returns its exit status; 2 if a signal has ended it, which is reported
int driver_status();

}  // namespace bielle::reduce
