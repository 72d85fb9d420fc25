// The message of an expected exception, for tests of messages.
#pragma once

#include <string>

namespace bielle::test {

/// Returns the message of `Error` if `action` throws it; "(nothing thrown)" otherwise. Other exceptions pass through.
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
