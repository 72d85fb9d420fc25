// The ranks as a team: rank 0 receives commands and broadcasts them, distributes blocks and collects them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <mpi.h>

#include "reduce/distributed/channel.hpp"

namespace bielle::reduce {

/// A command with its two numbers.
struct Order {
  Command command = Command::leave;
  std::int64_t a = 0, b = 0;
};

/// An exception of the work on some rank, thrown on all of them.
struct RankFailure {
  Outcome outcome;
};

class Team {
 public:
  /// @param channel  to bielle-reduce on rank 0, nullptr on all others
  Team(MPI_Comm comm, Channel* channel);

  MPI_Comm comm() const { return comm_; }
  int rank() const { return rank_; }
  bool leads() const { return rank_ == 0; }
  Channel& channel() { return *channel_; }  ///< on rank 0 alone

  /// Returns the next command, which is the same on all ranks. Waiting ranks sleep. The command is `leave`, with status
  /// -1, if bielle-reduce has ended.
  Order next();

  /// Does the work on every rank and returns when all have done it.
  /// @throws RankFailure on all ranks if the work threw on any; the failure is that of the first such rank
  void all_or_none(const std::function<void()>& work);

  /// Reads blocks from the channel; each rank gets its own.
  std::vector<double> share_numbers();
  std::pair<std::vector<double>, std::vector<double>> share_two_blocks();
  std::string share_text();
  /// Writes each rank's block into the channel, one after the other.
  void collect_numbers(const std::vector<double>& block);

  /// Sum over all ranks, on rank 0.
  void add_up(double* values, std::size_t count);

 private:
  std::vector<std::vector<double>> share_blocks(int count);
  MPI_Comm comm_;
  Channel* channel_;
  int rank_ = 0, size_ = 1;
};

}  // namespace bielle::reduce
