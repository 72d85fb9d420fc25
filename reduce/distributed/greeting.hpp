// How the ranks greet bielle-reduce.
#pragma once

#include <cstdint>

namespace bielle::reduce {

/// How many they are, and how many of them are on the machine of bielle-reduce.
struct Greeting {
  std::int64_t ranks = 1, ranks_here = 1;
};

}  // namespace bielle::reduce
