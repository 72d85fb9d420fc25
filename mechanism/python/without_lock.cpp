#include "mechanism/python/without_lock.hpp"

#include <atomic>
#include <chrono>
#include <thread>

namespace bielle::python {
namespace {

// These variables belong to the whole process, as Python's lock does.
std::atomic<int> computing = 0;
std::atomic<bool> ending = false, abandoned = false;

[[noreturn]] void raise_system_exit() {
  PyErr_SetNone(PyExc_SystemExit);
  throw pybind11::error_already_set();
}

/// Stops this thread for good if the program has ended without waiting for it: the lock cannot be taken any more.
void stay_away_if_abandoned() {
  while (abandoned) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Waits for all computations, up to a minute, when the program ends. (A step of a large model takes some time; a
/// thread may never end.)
void end_computing() {
  constexpr std::chrono::seconds longest{60};
  ending = true;
  const pybind11::gil_scoped_release free;
  const auto end = std::chrono::steady_clock::now() + longest;
  while (computing > 0 && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  abandoned = computing > 0;
}

}  // namespace

WithoutLock::WithoutLock() {
  if (ending) raise_system_exit();
  ++computing;
  state_ = PyEval_SaveThread();
}

WithoutLock::~WithoutLock() {
  stay_away_if_abandoned();
  PyEval_RestoreThread(state_);
  --computing;
}

void end_with_program() {
  if (!ending) return;
  stay_away_if_abandoned();
  const pybind11::gil_scoped_acquire lock;
  raise_system_exit();
}

void bind_end(pybind11::module_& /*module*/) {
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(end_computing));
}

}  // namespace bielle::python
