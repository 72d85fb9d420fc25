// Twice as many placed parts take about twice as many allocations: to be written out, read and set up, described as by
// --check, and refused with a message about the last of them. Allocations do not depend on the machine's load.
#include <catch2/catch.hpp>

#include "mechanism/io/describe_model.hpp"
#include "mechanism/system/system.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/large_models.hpp"
#include "tests/unit/mechanism/language/expanded.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::AllocationCount;
using bielle::test::links_of_parts;
using Catch::Contains;

namespace {

/// Returns the number of allocations for twice as many parts, over that for `parts`.
/// @param work  takes the text of a model and its number of parts
template <typename Work>
double growth(const Work& work, int parts = 100) {
  const auto calls = [&](int n) {
    const std::string text = links_of_parts(n);
    const AllocationCount count;
    work(text, n);
    return static_cast<double>(count.calls());
  };
  calls(1);  // makes the tables of keys
  const double few = calls(parts);
  return calls(2 * parts) / few;
}

constexpr double most = 2.2;

}  // namespace

TEST_CASE("allocations grow with the number of parts that are written out and set up") {
  CHECK(growth([](const std::string& text, int) {
          expand_model(parse_yaml(text, "model.yaml"), "model.yaml", mechanism_file_keys(), {});
        }) < most);
  CHECK(growth([](const std::string& text, int) {
          const MechanismFile file = read_mechanism_text(text, "model.yaml");
          const System system(file.model);
        }) < most);
  CHECK(growth([](const std::string& text, int) { describe_model(read_mechanism_text(text, "model.yaml")); }) < most);
}

TEST_CASE("allocations for a message grow with the number of parts") {
  const auto refused = [](const std::string& text) {
    return test::message_of<InputError>([&] { read_mechanism_text(text, "model.yaml"); });
  };
  CHECK(growth([&](const std::string& text, int n) {
          const std::string last = fmt::format("  last: {{part: link, merge: {{root: link_{}.edn}}}}\n", n);
          CHECK_THAT(refused(text + last), Contains("parts.last.merge") && Contains(fmt::format("'link_{}.end'", n)));
        }) < most);
  CHECK(growth([&](const std::string& text, int n) {
          const std::string load = fmt::format("loads: {{pull: {{node: link_{}.edn, force: [0, 0, 1]}}}}\n", n);
          CHECK_THAT(refused(text + load), Contains("loads.pull.node") && Contains(fmt::format("'link_{}.end'", n)));
        }) < most);
}
