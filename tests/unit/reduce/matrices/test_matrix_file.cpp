// Tests of the matrix file: a file of its layout is read, and one whose parts do not fit together is refused.
#include <functional>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/matrices/matrix_set.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

using Integers = std::vector<std::int64_t>;

/// Returns a spring of 4 N/m between two masses of 2 kg along x; the caller may change the file before it is closed.
std::string spring_file(const std::string& path, const std::function<void(Hdf5File&)>& change = {}) {
  Hdf5File file = Hdf5File::create(path);
  file.write_attribute("/", "format", "bielle matrices");
  file.write_attribute("/", "version", 1);
  file.write_attribute("/", "name", "spring");
  file.write_attribute("/", "source", "test");
  file.write("/nodes/numbers", Integers{7, 8}, {2}, "-");
  file.write("/nodes/positions", std::vector<double>{0, 0, 0, 1, 0, 0}, {2, 3}, "m");
  file.write("/unknowns/nodes", Integers{0, 1}, {2}, "-");
  file.write("/unknowns/components", Integers{0, 0}, {2}, "-");
  file.write("/stiffness/rows", Integers{0, 0, 1, 1}, {4}, "-");
  file.write("/stiffness/columns", Integers{0, 1, 0, 1}, {4}, "-");
  file.write("/stiffness/values", std::vector<double>{4, -4, -4, 4}, {4}, "-");
  file.write("/mass/rows", Integers{0, 1}, {2}, "-");
  file.write("/mass/columns", Integers{0, 1}, {2}, "-");
  file.write("/mass/values", std::vector<double>{2, 2}, {2}, "-");
  if (change) change(file);
  file.close();
  return path;
}

}  // namespace

TEST_CASE("A matrix file is read") {
  const test::TemporaryFolder scratch;
  const MatrixSet set = read_matrix_set(spring_file(scratch / "spring.h5"));
  CHECK(set.name == "spring");
  CHECK(set.numbers == std::vector<std::int64_t>{7, 8});
  CHECK(set.positions(0, 1) == 1);
  CHECK(set.name_of(1) == "node 8 x");
  CHECK(set.stiffness.coeff(0, 1) == -4);
  CHECK(set.mass.coeff(1, 1) == 2);
  CHECK_FALSE(set.has_units);
  CHECK(set.damping.size() == 0);
  CHECK_FALSE(set.shapes.has_value());
}

TEST_CASE("A matrix file whose parts do not fit together is refused") {
  const test::TemporaryFolder scratch;
  const auto refused = [&](const std::function<void(Hdf5File&)>& change, const std::string& words) {
    CHECK_THROWS_WITH(read_matrix_set(spring_file(scratch / "wrong.h5", change)), Contains(words));
  };
  const auto replaced = [](const std::string& dataset, const Integers& values) {
    return [=](Hdf5File& file) {
      file.remove(dataset);
      file.write(dataset, values, {values.size()}, "-");
    };
  };
  refused(replaced("/unknowns/nodes", {0, 2}), "2 is no node");
  refused(replaced("/unknowns/nodes", {0}), "differ in size");
  refused(replaced("/unknowns/components", {0, 6}), "6 is no component");
  refused(replaced("/stiffness/rows", {0, 0, 1, 2}), "outside a matrix of 2 unknowns");
  refused(replaced("/stiffness/rows", {0, 0, 1}), "differ in size");
  refused(replaced("/nodes/numbers", {7}), "/nodes/positions");
  refused([](Hdf5File& file) { file.write_attribute("/", "version", 2); }, "version 2");
  refused([](Hdf5File& file) { file.write_attribute("/", "format", "bielle superelement"); }, "no file of matrices");
  for (const double wrong : {std::nan(""), 1e300})
    refused(
        [wrong](Hdf5File& file) {
          file.remove("/mass/values");
          file.write("/mass/values", std::vector<double>{2, wrong}, {2}, "-");
        },
        "/mass/values holds the number");
}
