// Work variables of functions that may be called recursively: a formula reads a measure, which is a formula of other
// measures, and so on.
#pragma once

#include <cstddef>
#include <deque>

namespace bielle::mechanism {

/// A variable T for the exclusive use of one call during its lifetime, taken from a stack of each thread: memory is
/// allocated only when the nesting becomes deeper than before. Its initial value is left over from earlier uses.
/// @tparam Owner  any type; calls with the same type share the stack
template <class T, class Owner = T>
class Nested {
 public:
  Nested() {
    Stack& stack = of_thread();
    if (stack.items.size() == stack.level) stack.items.emplace_back();
    item_ = &stack.items[stack.level++];
  }
  ~Nested() { --of_thread().level; }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  T& operator*() { return *item_; }
  T* operator->() { return item_; }

 private:
  struct Stack {
    std::deque<T> items;  // a deque does not move its elements
    std::size_t level = 0;
  };
  static Stack& of_thread() {
    thread_local Stack stack;
    return stack;
  }
  T* item_;
};

}  // namespace bielle::mechanism
