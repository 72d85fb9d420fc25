// What bears only where it touches, and says what does not: a static analysis that finds nothing to hold a part tells
// it.
#pragma once

#include <string>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class OpenContact {
 public:
  virtual ~OpenContact() = default;
  /// A clause on what is open, or nothing where all of it touches: "is open by 0.01 m".
  virtual std::string what_is_open(const LocalState& state) const = 0;

 protected:
  OpenContact() = default;
  OpenContact(const OpenContact&) = default;
  OpenContact& operator=(const OpenContact&) = default;
};

}  // namespace bielle::mechanism
