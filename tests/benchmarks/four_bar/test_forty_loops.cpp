// The N-loop four-bar (loops.hpp) in the size of the library: forty loops, 81 bars, 600 constraints, many of which are
// redundant.
#include "tests/benchmarks/four_bar/loops.hpp"

TEST_CASE("forty loops of four-bars pass the positions with all bars in one line, and stay parallelograms") {
  bielle::four_bar::check_loops(40);
}
