#include "reduce/distributed/distributed_modes.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

/// Answers until the ranks send no further request. @returns the number of solutions
int answer_questions(Channel& channel, const ShiftInvertProblem& problem, const EigenpairOptions& options) {
  Eigen::MatrixXd x(problem.size, 1);
  const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(problem.size);
  int solves = 0;
  while (true) {
    const auto question = channel.receive_number<Question>();
    if (question == Question::none) return solves;
    channel.receive(x.data(), bytes);
    const Eigen::MatrixXd y = question == Question::mass_times ? problem.multiply_mass(x) : problem.solve(x);
    if (question == Question::solution && options.on_solve) options.on_solve(solves + 1);
    if (question == Question::solution) ++solves;
    channel.send_number(Command::answer);
    channel.send_number(std::int64_t{0});
    channel.send_number(std::int64_t{0});
    channel.send(y.data(), bytes);
  }
}

}  // namespace

Eigenpairs distributed_modes(Channel& channel, const ShiftInvertProblem& problem, int count,
                             const EigenpairOptions& options) {
  channel.send_number(Command::modes);
  channel.send_number(static_cast<std::int64_t>(problem.size));
  channel.send_number(static_cast<std::int64_t>(count));
  channel.send_number(options.tolerance);
  channel.send_number(static_cast<std::int64_t>(options.restarts));
  Eigenpairs pairs;
  pairs.method = "SLEPc";
  pairs.solves = pairs.sweeps = answer_questions(channel, problem, options);
  const Outcome outcome = channel.receive_outcome();
  if (outcome.kind != Outcome::good) throw ComputationError(outcome.message);
  const auto found = static_cast<Eigen::Index>(channel.receive_number<std::int64_t>());
  Eigen::VectorXd values(found);
  channel.receive(values.data(), sizeof(double) * static_cast<std::size_t>(found));
  // The lowest eigenpairs are read from the stream, which sends them in ascending order.
  const Eigen::Index wanted = std::min<Eigen::Index>(found, count);
  pairs.values = values.head(wanted);
  pairs.vectors.resize(problem.size, wanted);
  Eigen::VectorXd rest(problem.size);
  for (Eigen::Index k = 0; k < found; ++k)
    channel.receive(k < wanted ? pairs.vectors.col(k).data() : rest.data(),
                    sizeof(double) * static_cast<std::size_t>(problem.size));
  return pairs;
}

}  // namespace bielle::reduce
