// bielle-reduce-mpi: bielle-reduce on several ranks or machines, started by mpirun.
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <malloc.h>
#include <mpi.h>

#include "reduce/common/error.hpp"
#include "reduce/common/process/library_settings.hpp"
#include "reduce/distributed/greeting.hpp"
#include "reduce/distributed/ranks/driver.hpp"
#include "reduce/distributed/ranks/service.hpp"

namespace {

using namespace bielle;
using namespace bielle::reduce;

/// Prints the reason and ends all ranks.
void end_all(int rank, const char* why) {
  std::fputs(fmt::format("bielle-reduce-mpi: error: rank {}: {}\n", rank, why).c_str(), stderr);
  MPI_Abort(MPI_COMM_WORLD, 2);
}

Greeting greeting() {
  int ranks = 1, here = 1;
  MPI_Comm machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_size(machine, &here);
  MPI_Comm_free(&machine);
  return {ranks, here};
}

void work(int argc, char** argv, int rank) {
  const Greeting of_ranks = greeting();
  std::unique_ptr<Channel> channel;
  if (rank == 0) {
    channel = start_driver(argc, argv);
    channel->send_number(of_ranks);
  }
  Team team(MPI_COMM_WORLD, channel.get());
  Service service(team);
  service.serve();
  leave(rank == 0 ? driver_status() : 0);
}

}  // namespace

int main(int argc, char** argv) {
  apply_library_settings(argv);
  std::signal(SIGPIPE, SIG_IGN);
  mallopt(M_MMAP_THRESHOLD, 1 << 20);  // large blocks are returned to the system when they are freed
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    work(argc, argv, rank);
  } catch (const std::bad_alloc&) {
    end_all(rank, "out of memory");
  } catch (const std::exception& error) {
    end_all(rank, error.what());
  } catch (const RankFailure& failure) {
    end_all(rank, failure.outcome.message.c_str());
  }
  return 2;
}
