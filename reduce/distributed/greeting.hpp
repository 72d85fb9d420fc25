// The first message of the ranks to bielle-reduce.
#pragma once

#include <cstdint>

namespace bielle::reduce {

/// Number of ranks, and number of those on the machine of bielle-reduce.
struct Greeting {
  std::int64_t ranks = 1, ranks_here = 1;
};

}  // namespace bielle::reduce
