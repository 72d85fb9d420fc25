// One session computes for one caller at a time, even if Python has several threads.
//
// While a session computes, Python's lock (the GIL) is released: other threads of Python run, and may use the same
// session. Their calls are rejected with a message. A callback of the session may read it, but not compute with it.
// All functions here are called with the lock held.
#pragma once

#include <stdexcept>
#include <thread>

namespace bielle::python {

class Gate {
 public:
  /// During the lifetime of this object, the session computes.
  class Computing {
   public:
    /// @throws std::logic_error if the session already computes
    explicit Computing(Gate& gate) : gate_(gate) {
      gate.check_idle();
      gate.computing_ = true;
      gate.thread_ = std::this_thread::get_id();
    }
    ~Computing() { gate_.computing_ = false; }
    Computing(const Computing&) = delete;
    Computing& operator=(const Computing&) = delete;

   private:
    Gate& gate_;
  };

  /// During the lifetime of this object, a computing session calls back.
  class Calling {
   public:
    explicit Calling(Gate& gate) : gate_(gate) { gate.calling_ = true; }
    ~Calling() { gate_.calling_ = false; }
    Calling(const Calling&) = delete;
    Calling& operator=(const Calling&) = delete;

   private:
    Gate& gate_;
  };

  bool computing() const { return computing_; }
  /// @throws std::logic_error unless the session is ready to compute
  void check_idle() const {
    check_readable();
    if (computing_)
      throw std::logic_error("the session is computing: a callback may read it, set its inputs and stop it");
  }
  /// @throws std::logic_error unless this thread may read the session
  void check_readable() const {
    if (computing_ && !(calling_ && thread_ == std::this_thread::get_id()))
      throw std::logic_error("the session is computing in another thread");
  }

 private:
  bool computing_ = false, calling_ = false;
  std::thread::id thread_;
};

}  // namespace bielle::python
