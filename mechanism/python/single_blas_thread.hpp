// Restricts BLAS to one thread while Bielle computes, as in the programs; the number is restored afterwards.
#pragma once

#include <memory>
#include <mutex>

#include "reduce/dense/blas.hpp"

namespace bielle::python {

/// NumPy may share the BLAS and needs its threads. Several of these objects may exist at the same time: the first sets
/// one thread, the last restores the others.
class SingleBlasThread {
 public:
  SingleBlasThread() {
    const std::lock_guard<std::mutex> lock(guard_);
    if (living_++ == 0) one_ = std::make_unique<BlasThreads>(1);
  }
  ~SingleBlasThread() {
    const std::lock_guard<std::mutex> lock(guard_);
    if (--living_ == 0) one_.reset();
  }
  SingleBlasThread(const SingleBlasThread&) = delete;
  SingleBlasThread& operator=(const SingleBlasThread&) = delete;

 private:
  static inline std::mutex guard_;
  static inline int living_ = 0;
  static inline std::unique_ptr<BlasThreads> one_;
};

}  // namespace bielle::python
