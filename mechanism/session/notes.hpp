// Receiver of messages of a session while it works. Without such an object the session writes no messages.
#pragma once

#include <functional>
#include <string>

namespace bielle::mechanism {

class Notes {
 public:
  virtual ~Notes() = default;
  /// @param done  completed fraction of the present computation, 0..1
  /// @param at    returns the place, "t = 0.013 s"; it is called only if it is shown, which most steps are not
  virtual void progress(double /*done*/, const std::function<std::string()>& /*at*/) {}
  /// Receives a sentence for the user.
  virtual void note(const std::string& /*sentence*/) {}
};

}  // namespace bielle::mechanism
