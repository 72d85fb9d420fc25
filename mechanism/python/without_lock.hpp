// Computations without Python's lock (the GIL), and the end of the program during such a computation.
//
// A thread that requests the lock after Python has begun to end is terminated by Python immediately, through C++ frames
// that cannot be left in this way: the program aborts. Therefore, before Python ends, computations are asked to stop
// between two steps (their threads get a SystemExit, which ends them quietly), and the program waits for them. A call
// that takes too long until its next step is abandoned: its thread never returns.
#pragma once

#include <pybind11/pybind11.h>

namespace bielle::python {

/// During the lifetime of this object, Python's lock is released.
class WithoutLock {
 public:
  WithoutLock();  ///< @throws SystemExit if the program ends
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* state_;
};

/// Call it between two steps, without the lock. @throws SystemExit if the program ends
void end_with_program();

void bind_end(pybind11::module_& module);

}  // namespace bielle::python
