// bielle-reduce, started by rank 0: it reads the body file, reduces, checks and writes as it does alone, and leaves to
// the ranks what is large. It is a process of its own, since PETSc brings another HDF5 than the one that superelements
// are written with.
#pragma once

#include <memory>

#include "reduce/distributed/channel.hpp"

namespace bielle::reduce {

/// Starts the bielle-reduce next to this program with its arguments. @throws ComputationError when it is not there
std::unique_ptr<Channel> start_driver(int argc, char** argv);

/// Waits for its end. @returns its exit status; 2 when a signal has ended it, which is said
int driver_status();

}  // namespace bielle::reduce
