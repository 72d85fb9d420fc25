// Threads that work on one thing together: all call the same functions in the same order, share out what is in them,
// and wait for each other. One thread alone is a team as well.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace bielle {

/// What a team has in common.
class TeamWork {
 public:
  /// The next of the numbers 0, 1, .. that nobody has taken, in the `turn`-th piece of work.
  std::int64_t take(int turn) { return next_[static_cast<std::size_t>(turn % 3)].fetch_add(1); }
  /// By one thread, while others may still be in this turn: of the next one nobody is left from three turns ago.
  void prepare(int turn) { next_[static_cast<std::size_t>(turn % 3)].store(0); }
  std::int64_t common = 0;

 private:
  std::array<std::atomic<std::int64_t>, 3> next_{};
};

/// One thread's place in a team. All members of a team within an OpenMP region are its threads.
class Team {
 public:
  Team() = default;  ///< alone
  Team(int rank, int size, TeamWork& work) : rank_(rank), size_(size), work_(&work) {}

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Calls `work(k)` for k = 0 .. count-1, each by the thread that is free, and waits until all are done.
  template <class Work>
  void share(std::int64_t count, const Work& work) {
    if (size_ == 1) {
      for (std::int64_t k = 0; k < count; ++k) work(k);
      return;
    }
    for (std::int64_t k = work_->take(turn_); k < count; k = work_->take(turn_)) work(k);
    if (rank_ == 0) work_->prepare(turn_ + 1);
    ++turn_;
    wait();
  }
  /// Calls `work()` in one thread, and waits.
  template <class Work>
  void once(const Work& work) {
    if (rank_ == 0) work();
    wait();
  }
  /// A number that one thread tells the others.
  std::int64_t& common() { return size_ == 1 ? own_ : work_->common; }
  void wait() const {
    if (size_ > 1) {
#pragma omp barrier
    }
  }

 private:
  int rank_ = 0, size_ = 1, turn_ = 0;
  TeamWork* work_ = nullptr;
  std::int64_t own_ = 0;
};

}  // namespace bielle
