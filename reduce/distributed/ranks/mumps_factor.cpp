#include "reduce/distributed/ranks/mumps_factor.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <dmumps_c.h>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/process/free_memory.hpp"

namespace bielle::reduce {

namespace {

enum Job { begin = -1, end = -2, analysis = 1, factorisation = 2, solution = 3 };

// Indices of MUMPS's lists start at 1 in its manual, "MUMPS 5.5.1 Users' guide".
constexpr int workspace_too_small[] = {-8, -9, -14, -15, -17, -20};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Returns a count of MUMPS, which gives those beyond 32 bits in millions with a negative sign.
double counted_large(int value) { return value < 0 ? -1e6 * value : value; }

}  // namespace

struct MumpsFactor::Instance {
  DMUMPS_STRUC_C id{};
  Entries entries;

  int& control(int place) { return id.icntl[place - 1]; }
  int information(int place) const { return id.info[place - 1]; }
  int of_all(int place) const { return id.infog[place - 1]; }
  void run(Job job) {
    id.job = job;
    dmumps_c(&id);
  }
};

MumpsFactor::MumpsFactor(Team& team, int size, Entries entries, const std::vector<int>& block_starts)
    : team_(team), instance_(std::make_unique<Instance>()) {
  Instance& m = *instance_;
  m.entries = std::move(entries);
  m.id.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(team.comm()));
  m.id.par = 1;
  m.id.sym = 1;
  m.run(begin);
  for (const int place : {1, 2, 3}) m.control(place) = -1;  // MUMPS prints nothing
  m.control(4) = 0;
  m.control(18) = 3;   // entries are distributed
  m.control(14) = 20;  // per cent more workspace than estimated
  m.control(27) = 16;  // right-hand sides at a time
  m.id.n = size;
  m.id.nnz_loc = static_cast<MUMPS_INT8>(m.entries.values.size());
  m.id.irn_loc = m.entries.rows.data();
  m.id.jcn_loc = m.entries.columns.data();
  m.id.a_loc = m.entries.values.data();
  try {
    analyse(block_starts);
    check_memory();
    factorise();
  } catch (...) {
    m.run(end);
    throw;
  }
  m.entries = {};
  m.id.irn_loc = m.id.jcn_loc = nullptr;
  m.id.a_loc = nullptr;
}

MumpsFactor::~MumpsFactor() { instance_->run(end); }

int MumpsFactor::size() const { return instance_->id.n; }

void MumpsFactor::analyse(const std::vector<int>& block_starts) {
  Instance& m = *instance_;
  const auto start = std::chrono::steady_clock::now();
  std::vector<int> starts, variables;
  if (team_.leads()) {
    for (const int first : block_starts) starts.push_back(first + 1);
    m.id.nblk = static_cast<int>(block_starts.size()) - 1;
    m.id.blkptr = starts.data();
  }
  m.control(15) = 1;
  m.control(7) = 5;  // METIS
  m.run(analysis);
  m.id.blkptr = nullptr;
  statistics_.analysis_seconds = seconds_since(start);
  team_.all_or_none([&] {
    if (m.of_all(1) < 0)
      throw ComputationError(fmt::format("not enough memory for the analysis of the stiffness matrix (MUMPS: {}, {})",
                                         m.of_all(1), m.of_all(2)));
  });
}

/// Throws if the factor needs more memory than there is: the machine would run out of it minutes later.
void MumpsFactor::check_memory() {
  const Instance& m = *instance_;
  MPI_Comm machine;
  MPI_Comm_split_type(team_.comm(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  double needed = m.information(15);
  MPI_Allreduce(MPI_IN_PLACE, &needed, 1, MPI_DOUBLE, MPI_SUM, machine);
  double free = free_memory_MB();
  MPI_Allreduce(MPI_IN_PLACE, &free, 1, MPI_DOUBLE, MPI_MIN, machine);
  MPI_Comm_free(&machine);
  statistics_.estimated_MB = m.of_all(17);
  team_.all_or_none([&] {
    if (needed > free)
      throw ComputationError(
          fmt::format("the factorised stiffness matrix of {} unknowns needs about {:.0f} MB on the machine of rank {}, "
                      "but only {:.0f} MB of memory are free there; a coarser mesh needs less, or more machines",
                      m.id.n, needed, team_.rank(), free));
  });
}

void MumpsFactor::factorise() {
  Instance& m = *instance_;
  const auto start = std::chrono::steady_clock::now();
  m.run(factorisation);
  const auto too_small = [&] {
    return std::find(std::begin(workspace_too_small), std::end(workspace_too_small), m.of_all(1)) !=
           std::end(workspace_too_small);
  };
  for (int attempt = 0; attempt < 3 && too_small(); ++attempt) {
    m.control(14) *= 2;
    m.run(factorisation);
  }
  statistics_.factorisation_seconds = seconds_since(start);
  team_.all_or_none([&] {
    const int status = m.of_all(1);
    if (status == -10 || status == -40)
      throw ComputationError(
          "the stiffness of the body is singular: a part of the mesh is attached at a point or an edge only, or its "
          "cells are degenerate");
    if (status < 0)
      throw ComputationError(
          fmt::format("not enough memory for the factorisation of the stiffness matrix; a coarser mesh needs less, or "
                      "more machines "
                      "(MUMPS: {}, {})",
                      status, m.of_all(2)));
  });
  statistics_.nonzeros = counted_large(m.of_all(29));
  statistics_.flops = m.id.rinfog[3 - 1];
  statistics_.negative_pivots = m.of_all(12);
}

void MumpsFactor::solve(double* b, int columns) {
  Instance& m = *instance_;
  m.id.rhs = b;
  m.id.nrhs = columns;
  m.id.lrhs = m.id.n;
  m.run(solution);
  m.id.rhs = nullptr;
  team_.all_or_none([&] {
    if (m.of_all(1) < 0)
      throw ComputationError(
          fmt::format("not enough memory for the solution with the factorised stiffness matrix (MUMPS: {}, {})",
                      m.of_all(1), m.of_all(2)));
  });
}

}  // namespace bielle::reduce
