// A checksum that tells whether numbers in a file are still those that were written.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

namespace bielle {

/// A sum of 52 bits over numbers and texts in their order. It detects damage and edits, but no deliberate forgery.
class Checksum {
 public:
  void add(std::span<const double> values) {
    for (const double value : values) add_word(std::bit_cast<std::uint64_t>(value));
  }
  void add(double value) { add({&value, 1}); }
  void add(std::span<const std::int64_t> values) {
    for (const std::int64_t value : values) add_word(static_cast<std::uint64_t>(value));
  }
  void add(std::string_view text) {
    add_word(text.size());
    for (const char letter : text) add_word(static_cast<unsigned char>(letter));
  }
  /// Returns a whole number that a double holds exactly.
  std::int64_t value() const { return static_cast<std::int64_t>(sum_ >> 12); }

 private:
  /// Multiplies by the prime of Fowler, Noll and Vo, one word at a time; the shift lets high bits affect low ones.
  void add_word(std::uint64_t word) {
    sum_ = (sum_ ^ word) * 0x100000001b3u;
    sum_ ^= sum_ >> 29;
  }
  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

}  // namespace bielle
