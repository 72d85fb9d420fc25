// Interface of contacts that can describe whether they are open: a static analysis that finds an unsupported part
// includes it in its message.
#pragma once

#include <string>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class OpenContact {
 public:
  virtual ~OpenContact() = default;
  /// Returns a clause on the open part, or empty if the whole contact touches: "is open by 0.01 m".
  virtual std::string what_is_open(const LocalState& state) const = 0;

 protected:
  OpenContact() = default;
  OpenContact(const OpenContact&) = default;
  OpenContact& operator=(const OpenContact&) = default;
};

}  // namespace bielle::mechanism
