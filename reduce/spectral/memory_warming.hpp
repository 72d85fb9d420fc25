// Memory that the machine has at hand before it is needed.
#pragma once

#include <cstddef>
#include <thread>

namespace bielle {

/// While it lives, a thread of its own touches memory, up to so many bytes, and gives it back in the end. Virtual
/// machines ask their host for memory when it is first written to, which may take seconds for each gigabyte; what has
/// been given back comes again at once. Where memory is scarce nothing is done.
class MemoryWarming {
 public:
  explicit MemoryWarming(std::size_t bytes);
  ~MemoryWarming();
  MemoryWarming(const MemoryWarming&) = delete;
  MemoryWarming& operator=(const MemoryWarming&) = delete;

 private:
  void* memory_ = nullptr;
  std::jthread thread_;
};

}  // namespace bielle
