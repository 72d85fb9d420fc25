#include "reduce/spectral/memory_warming.hpp"

#include <cstdlib>
#include <system_error>

#include "reduce/common/free_memory.hpp"
#include "reduce/spectral/huge_pages.hpp"

namespace bielle {

MemoryWarming::MemoryWarming(std::size_t bytes) {
  constexpr std::size_t page = std::size_t{2} << 20, worth_it = 16 * page;
  constexpr double plenty = 3;
  if (bytes < worth_it || plenty * 1e-6 * static_cast<double>(bytes) > free_memory_MB()) return;
  memory_ = allocate_in_huge_pages(bytes);
  if (memory_ == nullptr) return;
  const auto touch = [start = static_cast<volatile char*>(memory_), bytes](const std::stop_token& stop) {
    constexpr std::size_t small_page = 4096;
    for (std::size_t at = 0; at < bytes && !stop.stop_requested(); at += small_page) start[at] = 1;
  };
  try {
    thread_ = std::jthread(touch);
  } catch (const std::system_error&) {  // no more threads: it will be asked for in time
  }
}

MemoryWarming::~MemoryWarming() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  std::free(memory_);
}

}  // namespace bielle
