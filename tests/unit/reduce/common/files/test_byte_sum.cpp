#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/files/byte_sum.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/common/files/hdf5_soundness.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using bielle::test::message_of;
using bielle::test::TemporaryFolder;

namespace {

std::string bytes_in_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string text_of_size(std::size_t size) {
  std::string text(size, ' ');
  for (std::size_t k = 0; k < size; ++k) text[k] = static_cast<char>('a' + (k * k + k / 7) % 26);
  return text;
}

}  // namespace

TEST_CASE("byte sum: a file with its sum is recognised, and so is every change of it") {
  const TemporaryFolder folder;
  // sizes next to one word, four words and one block of reading
  for (const std::size_t size : {0, 1, 7, 8, 31, 32, 33, 1000, 32767, 32768, 32769, 100000}) {
    CAPTURE(size);
    const std::string path = folder.file("whole", text_of_size(size));
    CHECK_FALSE(has_own_byte_sum(path));
    append_byte_sum(path);
    CHECK(has_own_byte_sum(path));
    const std::string whole = bytes_in_file(path);
    REQUIRE(whole.size() == size + 32);
    CHECK(whole.substr(0, size) == text_of_size(size));
    for (std::size_t place = 0; place < whole.size(); place += 1 + whole.size() / 50)
      for (const int bit : {0, 7}) {
        std::string changed = whole;
        changed[place] = static_cast<char>(changed[place] ^ (1 << bit));
        CHECK_FALSE(has_own_byte_sum(folder.file("changed", changed)));
      }
    CHECK_FALSE(has_own_byte_sum(folder.file("cut", whole.substr(0, whole.size() - 1))));
    CHECK_FALSE(has_own_byte_sum(folder.file("longer", whole + "x")));
    CHECK_FALSE(has_own_byte_sum(folder.file("shifted", "x" + whole)));
    if (size > 64) {
      std::string exchanged = whole;
      std::swap_ranges(exchanged.begin(), exchanged.begin() + 8, exchanged.begin() + 32);
      CHECK_FALSE(has_own_byte_sum(folder.file("exchanged", exchanged)));
    }
  }
  CHECK_FALSE(has_own_byte_sum(folder / "none"));
  CHECK_THAT(message_of<ComputationError>([&] { append_byte_sum(folder / "none"); }),
             Catch::Matchers::Contains("writing failed"));
}

TEST_CASE("byte sum: HDF5 reads a file with its sum, and removes the sum when it writes") {
  const TemporaryFolder folder;
  const std::string path = folder / "file.h5";
  Hdf5File::create(path).write("/x", 1.5, "m");
  CHECK_FALSE(is_as_written(path));
  append_byte_sum(path);
  CHECK(is_as_written(path));
  CHECK(Hdf5File::open(path).read_number("/x") == 1.5);
  CHECK(has_own_byte_sum(path));
  Hdf5File::open_to_extend(path).write("/y", 2.5, "m");
  CHECK_FALSE(has_own_byte_sum(path));
  CHECK_FALSE(is_as_written(path));
  CHECK(Hdf5File::open(path).read_number("/y") == 2.5);
}
