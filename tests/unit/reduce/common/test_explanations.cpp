#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/explanations.hpp"
#include "tests/support/messages.hpp"

using bielle::explain;
using bielle::Explanation;
using bielle::explanation_of;
using bielle::InputError;
using bielle::read_explanations;
using bielle::test::message_of;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace test_explanations {
namespace {

constexpr const char* page = R"(# Messages about tests

A text before the first name.

## singular-equations

> - the equations are singular at ..: ..
> - nothing determines it

**Cause.** A node has no mass.

**Cure.** See [the page](page.md#mass) of masses.

## singular-wheel

> the equations are singular at ..: the wheel ..

**Cause.** A wheel.

## cut-file

> '..' cannot be read: it is cut off

**Cause.** A copy that ended early.
)";

const std::vector<Explanation>& samples() {
  static const std::vector<Explanation> read = read_explanations({page});
  return read;
}

std::string name_for(const std::string& message) {
  const Explanation* found = explanation_of(samples(), message);
  return found ? found->name : "none";
}

}  // namespace

TEST_CASE("Explanations are read from pages") {
  REQUIRE(samples().size() == 3);
  CHECK(samples()[0].name == "singular-equations");
  CHECK(samples()[0].messages ==
        std::vector<std::string>{"the equations are singular at ..: ..", "nothing determines it"});
  CHECK(samples()[0].text == "**Cause.** A node has no mass.\n\n**Cure.** See [the page](page.md#mass) of masses.\n");
  CHECK(read_explanations({}).empty());
  CHECK(read_explanations({"# A page without names\n\n> a quotation\n"}).empty());
}

TEST_CASE("A message finds its explanation, the longest one that matches") {
  CHECK(name_for("model.yaml:3: t = 0.3 s: the equations are singular at x of node 'a': it has no mass") ==
        "singular-equations");
  CHECK(name_for("the equations are singular at rz of node 'hub': the wheel turns freely") == "singular-wheel");
  CHECK(name_for("the equations are\n  singular at x: y") == "singular-equations");  // line breaks of a terminal
  CHECK(name_for("it is cut off: '..' cannot be read") == "none");                   // the order matters
  CHECK(name_for("'rod.step' cannot be read: it is cut off") == "cut-file");
  CHECK(name_for("") == "none");
  CHECK(name_for("the equations are regular") == "none");
}

TEST_CASE("Explanations are found by names, messages, parts of messages and words") {
  const std::string text = explain(samples(), "singular-equations");
  CHECK(text ==
        "singular-equations\n\n    the equations are singular at ..: ..\n    nothing determines it\n\n"
        "Cause. A node has no mass.\n\nCure. See the page of masses.\n");
  CHECK(explain(samples(), "  singular-equations \n") == text);
  CHECK(explain(samples(), "error: Nothing determines  it") == text);  // with other capitals, words alone are found
  CHECK_THAT(explain(samples(), "wheel"), StartsWith("singular-wheel\n"));
  CHECK_THAT(explain(samples(), "SINGULAR"),
             Contains("singular-equations  ") && Contains("singular-wheel  ") && !Contains("cut-file"));
  CHECK_THAT(explain(samples(), "all"), Contains("singular-equations") && Contains("cut-file"));
}

TEST_CASE("Texts without an explanation give a list of names") {
  CHECK_THAT(message_of<InputError>([] { explain(samples(), "singular-equation"); }),
             Contains("did you mean 'singular-equations'?") && Contains("`--explain all` lists them"));
  for (const char* text : {"", "   ", "zebra", "7", "..", "\xff\xfe"})
    CHECK_THAT(message_of<InputError>([&] { explain(samples(), text); }),
               Contains("no explanation fits") && Contains("'; `--explain all` lists them"));
  CHECK_THAT(message_of<InputError>([] { explain({}, "all words"); }), Contains("no explanation fits"));
}

}  // namespace test_explanations
