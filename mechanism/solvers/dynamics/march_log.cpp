#include "mechanism/solvers/dynamics/march_log.hpp"

#include <algorithm>

namespace bielle::mechanism {

void MarchLog::exchange(Archive& archive, int equations) {
  for (long* count :
       {&steps, &iterations, &factorisations, &shortened, &refused_by_error, &refused_by_newton, &crossings})
    archive.within(*count, 0, 1e15);
  for (double* value : {&smallest, &largest, &most_iterations_at}) archive(*value);
  archive(most_iterations);
  archive.within(slowest_equation, -1, equations - 1);
}

MarchLog MarchLog::followed_by(const MarchLog& next) const {
  MarchLog both = next.most_iterations > most_iterations ? next : *this;  // the log of the hardest step is kept
  both.steps = steps + next.steps;
  both.iterations = iterations + next.iterations;
  both.factorisations = factorisations + next.factorisations;
  both.shortened = shortened + next.shortened;
  both.refused_by_error = refused_by_error + next.refused_by_error;
  both.refused_by_newton = refused_by_newton + next.refused_by_newton;
  both.crossings = crossings + next.crossings;
  both.smallest = smallest > 0 && next.smallest > 0 ? std::min(smallest, next.smallest) : smallest + next.smallest;
  both.largest = std::max(largest, next.largest);
  both.hardest = next.hardest.empty() ? hardest : next.hardest;
  return both;
}

}  // namespace bielle::mechanism
