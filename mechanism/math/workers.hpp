// Threads that share work which was cut into pieces before: results do not depend on how many there are.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>

#include <omp.h>

namespace bielle::mechanism {

/// A team of OpenMP's threads, the calling one among them.
class Workers {
 public:
  explicit Workers(int threads = 1) : threads_(std::max(threads, 1)) {}

  int threads() const { return threads_; }
  /// Calls piece(k) once for each k below `count`, in any order, by any thread; returns when all are done. Pieces of
  /// low number are begun first. Pieces must not throw, and write where no other piece reads or writes. Within a piece
  /// the calling thread does all by itself.
  template <class Piece>
  void for_each(std::size_t count, const Piece& piece) const {
    for_each(count, piece, [] {});
  }
  /// The same; the calling thread does `meanwhile`, which may throw, before it takes its part.
  template <class Piece, class Meanwhile>
  void for_each(std::size_t count, const Piece& piece, const Meanwhile& meanwhile) const {
    if (threads_ == 1 || count == 0 || omp_in_parallel()) {
      meanwhile();
      for (std::size_t k = 0; k < count; ++k) piece(k);
      return;
    }
    std::exception_ptr thrown;
    std::atomic<bool> abandoned = false;
#pragma omp parallel num_threads(threads_)
    {
#pragma omp master
      try {
        meanwhile();
      } catch (...) {
        thrown = std::current_exception();
        abandoned = true;
      }
#pragma omp for schedule(dynamic, 1) nowait
      for (std::size_t k = 0; k < count; ++k)
        if (!abandoned.load(std::memory_order_relaxed)) piece(k);
    }
    if (thrown) std::rethrow_exception(thrown);
  }

 private:
  int threads_;
};

}  // namespace bielle::mechanism
