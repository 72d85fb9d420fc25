// A motion held by Python.
#pragma once

#include <memory>
#include <utility>

#include "mechanism/python/working_session.hpp"

namespace bielle::python {

class HeldMotion {
 public:
  HeldMotion(std::shared_ptr<WorkingSession> session, std::unique_ptr<mechanism::Motion> motion)
      : session_(std::move(session)), motion_(std::move(motion)) {}
  ~HeldMotion() { session_->bury(std::move(motion_)); }
  HeldMotion(const HeldMotion&) = delete;
  HeldMotion& operator=(const HeldMotion&) = delete;

  WorkingSession& session() { return *session_; }
  /// Returns the motion for reading. @throws std::logic_error while its session computes in another thread
  mechanism::Motion& readable() {
    session_->gate()->check_readable();
    return *motion_;
  }
  template <class Act>
  auto compute(const Callbacks& callbacks, const Act& act) {
    return session_->compute(callbacks, [&](mechanism::Session&) { return act(*motion_); });
  }

 private:
  std::shared_ptr<WorkingSession> session_;
  std::unique_ptr<mechanism::Motion> motion_;
};

}  // namespace bielle::python
