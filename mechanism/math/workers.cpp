#include "mechanism/math/workers.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace bielle::mechanism {

struct Workers::Team {
  std::mutex mutex;
  std::condition_variable wanted, left;
  Work work{};
  std::atomic<std::size_t> next{0};     ///< number of the next piece
  std::atomic<unsigned> round{0};       ///< number of times that work has been distributed
  int at_work = 0;                      ///< number of other threads at work
  bool busy = false, stopping = false;  ///< work has been distributed; threads must end
  std::vector<std::thread> threads;

  void take_pieces() {
    for (std::size_t k; (k = next.fetch_add(1, std::memory_order_relaxed)) < work.count;) work.call(work.piece, k);
  }
  /// Spins for about ten microseconds before the thread sleeps.
  void linger(unsigned seen) const {
    constexpr int turns = 100;
    for (int k = 0; k < turns && round.load(std::memory_order_relaxed) == seen; ++k) std::this_thread::yield();
  }
  void serve() {
    for (unsigned seen = 0;;) {
      linger(seen);
      std::unique_lock lock(mutex);
      wanted.wait(lock, [&] { return stopping || round != seen; });
      if (stopping) return;
      seen = round;
      if (!busy) continue;  // the work is finished already
      ++at_work;
      lock.unlock();
      take_pieces();
      lock.lock();
      if (--at_work == 0) left.notify_one();
    }
  }
};

Workers::Workers(int threads) : threads_(std::max(threads, 1)), team_(std::make_unique<Team>()) {}

Workers::~Workers() {
  {
    const std::lock_guard lock(team_->mutex);
    team_->stopping = true;
    ++team_->round;
  }
  team_->wanted.notify_all();
  for (std::thread& thread : team_->threads) thread.join();
}

/// Starts as many threads as the system grants.
void Workers::start_threads() {
  Team& team = *team_;
  try {
    while (team.threads.size() + 1 < static_cast<std::size_t>(threads_))
      team.threads.emplace_back([&team] { team.serve(); });
  } catch (const std::system_error&) {
    threads_ = static_cast<int>(team.threads.size()) + 1;
  }
}

bool Workers::begin(const Work& work) {
  Team& team = *team_;
  {
    const std::lock_guard lock(team.mutex);
    if (team.busy) return false;
    start_threads();
    team.busy = true;
    team.work = work;
    team.next = 0;
    ++team.round;
  }
  team.wanted.notify_all();
  return true;
}

void Workers::take_part() { team_->take_pieces(); }

void Workers::end() {
  Team& team = *team_;
  std::unique_lock lock(team.mutex);
  team.next = team.work.count;  // after an exception no thread begins another piece
  team.left.wait(lock, [&] { return team.at_work == 0; });
  team.busy = false;
}

}  // namespace bielle::mechanism
