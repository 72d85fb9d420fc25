#include "reduce/common/files/byte_sum.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle {

namespace {

constexpr std::string_view label = "\nbielle sum of the file\n";
constexpr std::size_t word = sizeof(std::uint64_t), tail_size = label.size() + word;

using Tail = std::array<char, tail_size>;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open_file(const std::string& path, const char* mode) { return {std::fopen(path.c_str(), mode), std::fclose}; }

/// A sum over words in four independent rows, which a processor computes at the same time. A change of one word changes
/// it in any case.
class ByteSum {
 public:
  /// Adds a part of the file; all parts but the last are multiples of four words.
  void add(const char* bytes, std::size_t count) {
    size_ += count;
    for (; count >= rows_.size() * word; bytes += rows_.size() * word, count -= rows_.size() * word)
      for (std::size_t k = 0; k < rows_.size(); ++k) add_word(rows_[k], bytes + k * word, word);
    for (; count > 0; bytes += std::min(count, word), count -= std::min(count, word))
      add_word(rows_[0], bytes, std::min(count, word));
  }
  std::uint64_t value() const {
    std::uint64_t sum = size_;
    for (const std::uint64_t row : rows_) sum = mixed(sum ^ row);
    return sum;
  }

 private:
  static std::uint64_t mixed(std::uint64_t sum) {
    sum *= 0x9e3779b97f4a7c15u;
    return sum ^ std::rotr(sum, 29);
  }
  static void add_word(std::uint64_t& row, const char* bytes, std::size_t count) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes, count);
    row = std::rotl((row ^ value) * 0x100000001b3u, 23);
  }
  std::array<std::uint64_t, 4> rows_ = {1, 2, 3, 4};
  std::uint64_t size_ = 0;
};

/// Returns label and sum of the first bytes of a file, or nothing if it has fewer or cannot be read.
std::optional<Tail> tail_of(std::FILE* file, std::uint64_t size) {
  std::rewind(file);
  ByteSum sum;
  std::array<char, 32768> block;
  while (size > 0) {
    const std::size_t wanted = size < block.size() ? static_cast<std::size_t>(size) : block.size();
    if (std::fread(block.data(), 1, wanted, file) != wanted) return {};
    sum.add(block.data(), wanted);
    size -= wanted;
  }
  Tail tail;
  label.copy(tail.data(), label.size());
  const std::uint64_t value = sum.value();
  for (std::size_t k = 0; k < word; ++k) tail[label.size() + k] = static_cast<char>(value >> (8 * k));
  return tail;
}

std::optional<std::uint64_t> size_of(std::FILE* file) {
  if (std::fseek(file, 0, SEEK_END) != 0) return {};
  const long size = std::ftell(file);
  if (size < 0) return {};
  return static_cast<std::uint64_t>(size);
}

}  // namespace

void append_byte_sum(const std::string& path) {
  const auto fail = [&] { throw ComputationError(fmt::format("{}: writing failed; is the disk full?", path)); };
  File file = open_file(path, "r+b");
  if (!file) fail();
  const std::optional<std::uint64_t> size = size_of(file.get());
  const std::optional<Tail> tail = size ? tail_of(file.get(), *size) : std::nullopt;
  if (!tail || std::fseek(file.get(), 0, SEEK_END) != 0) fail();
  if (std::fwrite(tail->data(), 1, tail->size(), file.get()) != tail->size()) fail();
  if (std::fclose(file.release()) != 0) fail();
}

bool has_own_byte_sum(const std::string& path) {
  const File file = open_file(path, "rb");
  if (!file) return false;
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  const std::optional<std::uint64_t> size = size_of(file.get());
  if (!size || *size < tail_size) return false;
  Tail found;
  if (std::fseek(file.get(), -static_cast<long>(tail_size), SEEK_END) != 0) return false;
  if (std::fread(found.data(), 1, found.size(), file.get()) != found.size()) return false;
  if (std::string_view(found.data(), label.size()) != label) return false;
  return tail_of(file.get(), *size - tail_size) == found;
}

}  // namespace bielle
