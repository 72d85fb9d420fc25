// What a session has to say while it works. Without an object of this kind it is silent.
#pragma once

#include <string>

namespace bielle::mechanism {

class Notes {
 public:
  virtual ~Notes() = default;
  /// @param done  part of what is in hand, 0..1; @param where  "t = 0.013 s"
  virtual void progress(double /*done*/, const std::string& /*where*/) {}
  /// A sentence that the user should read.
  virtual void note(const std::string& /*sentence*/) {}
};

}  // namespace bielle::mechanism
