// The work of a rank for bielle-reduce: it keeps a part of the mesh's matrices and of the factor, and computes with
// them.
#pragma once

#include <memory>

#include "reduce/distributed/ranks/modes.hpp"
#include "reduce/distributed/ranks/mumps_factor.hpp"
#include "reduce/distributed/ranks/part.hpp"
#include "reduce/distributed/ranks/team.hpp"

namespace bielle::reduce {

class Service {
 public:
  explicit Service(Team& team) : team_(team) {}

  /// Executes commands until one that ends a loop: `answer` or `leave`. @returns the command that ended the loop
  Order serve();

 private:
  void carry_out(const Order& order);
  void keep(int threads);
  void factorise(int size);
  void solve(int columns);
  void multiply(const Order& order);
  void diagonal();
  void geometric(Eigen::Index fields, Eigen::Index shapes);
  void find(int size, int count);
  void tell(const Outcome& outcome);

  Team& team_;
  std::unique_ptr<Part> part_;
  std::unique_ptr<MumpsFactor> factor_;
};

/// Leaves MPI and ends this process. @param status  exit status of bielle-reduce, on rank 0
[[noreturn]] void leave(int status);

}  // namespace bielle::reduce
