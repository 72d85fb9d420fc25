// Work variables of functions that may be entered again before they have ended: a formula reads a measure, which is a
// formula of others, and so on.
#pragma once

#include <cstddef>
#include <deque>

namespace bielle::mechanism {

/// A T that is this function's alone while it lives, one of a stack that each thread keeps: it takes memory only where
/// the nesting becomes deeper than ever before. What it holds at first is left over from earlier uses.
/// @tparam Owner  who shares the stack; any type
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
    std::deque<T> items;  // which does not move them
    std::size_t level = 0;
  };
  static Stack& of_thread() {
    thread_local Stack stack;
    return stack;
  }
  T* item_;
};

}  // namespace bielle::mechanism
