// The cost of contacts: a hundred balls that fall to a floor.
//
//   performance_mechanism_contacts [BALLS_ALONG_A_SIDE]      default 10: 100 balls
//
// Balls side by side touch only the floor. They are measured in free fall, with contacts of each ball with the floor,
// and as one group in which every ball may touch every other. The difference of the last two is the cost of pairs that
// are far from each other. In a bin the balls form a heap. Each figure is the least processor time of three runs, all
// in one run of the program.
#include <algorithm>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/performance/processor_time.hpp"
#include "tests/support/balls_on_floor.hpp"

namespace {

using namespace bielle;
using namespace bielle::mechanism;

double measure(const char* what, const test::BallsOnFloor& balls, double compared) {
  const MechanismFile file = read_mechanism_text(balls.text(), "balls.yaml");
  double least = std::numeric_limits<double>::infinity(), touching = 0;
  MarchLog log;
  for (int round = 0; round < 3; ++round) {
    Session session(file.model);
    DynamicsOptions options;
    options.duration = 0.3;
    options.stepping.size = 5e-4;
    Motion motion = session.dynamics(options);
    const double begin = performance::processor_seconds();
    motion.finish();
    least = std::min(least, performance::processor_seconds() - begin);
    log = motion.log();
    touching = balls.contact ? session.read("contacts/it/state")[0] : 0;
  }
  fmt::print("{:<34} {:8.3f} ms per step, {:4.1f} iterations, {:5} factorisations, {:4.0f} pairs touch at the end",
             what, 1e3 * least / static_cast<double>(log.steps),
             static_cast<double>(log.iterations) / static_cast<double>(log.steps), log.factorisations, touching);
  if (compared > 0) fmt::print(", {:.2f} times", least / compared);
  fmt::print("\n");
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  test::BallsOnFloor balls;
  if (argc > 1) balls.along = std::atoi(argv[1]);
  test::BallsOnFloor free = balls, floor = balls, heap = balls;
  free.contact = false;
  floor.group = false;
  heap.heap = true;
  measure("free fall", free, 0);
  const double alone = measure("each on the floor", floor, 0);
  measure("one group, each with all", balls, alone);
  measure("a heap in a bin", heap, alone);
}
