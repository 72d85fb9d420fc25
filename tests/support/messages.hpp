// The message of an exception that is expected, for tests of what users read.
#pragma once

#include <string>

namespace bielle::test {

/// What `Error` says when `action` throws it; "(nothing thrown)" otherwise. Other exceptions pass.
template <class Error, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

}  // namespace bielle::test
