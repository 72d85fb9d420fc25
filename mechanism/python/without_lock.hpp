// Computing without Python's lock (the GIL), and the end of the program meanwhile.
//
// A thread that asks for the lock once Python has begun to end is ended by Python on the spot, through C++ frames that
// cannot be left like that: the program aborts. Hence, before Python ends, what computes is asked to stop between two
// steps (its thread gets a SystemExit, which ends it quietly), and the program waits for it. A call that does not come
// to a step for so long is left alone: its thread never comes back.
#pragma once

#include <pybind11/pybind11.h>

namespace bielle::python {

/// While it lives, Python's lock is released.
class WithoutLock {
 public:
  WithoutLock();  ///< @throws SystemExit where the program ends
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* state_;
};

/// Between two steps, without the lock. @throws SystemExit where the program ends
void end_with_program();

void bind_end(pybind11::module_& module);

}  // namespace bielle::python
