// Numbers of things in messages.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace bielle {

/// Returns a number with its noun: "1 step", "3 steps", "0 steps". @param plural  needed if it is not the noun with an
/// s: `counted(n, "degree of freedom", "degrees of freedom")`
template <std::integral Count>
std::string counted(Count count, std::string_view noun, std::string_view plural = {}) {
  if (count == Count{1}) return fmt::format("1 {}", noun);
  return plural.empty() ? fmt::format("{} {}s", count, noun) : fmt::format("{} {}", count, plural);
}

}  // namespace bielle
