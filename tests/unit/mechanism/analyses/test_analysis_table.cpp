// Types of analysis by name, and their keys.
#include <catch2/catch.hpp>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/dynamic.hpp"
#include "mechanism/analyses/static.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using Catch::Contains;

namespace {

std::unique_ptr<Analysis> read(const std::string& text) {
  return read_analysis(YamlValue::parse(text, "model.yaml"), Model());
}

std::string refusal(const std::string& text) {
  return test::message_of<InputError>([&] { read(text); });
}

}  // namespace

TEST_CASE("each type of the table gives an analysis of its name") {
  CHECK(read("{type: assembly}")->type() == "assembly");
  CHECK(read("{type: static}")->type() == "static");
  const auto dynamic = read("{type: dynamic, duration: 2, step: 0.1, start: equilibrium}");
  CHECK(dynamic->type() == "dynamic");
  CHECK(dynamic->duration() == 2);
  CHECK(dynamic->can_go_on());
  CHECK(dynamic_cast<const DynamicAnalysis&>(*dynamic).options().equilibrium);
  CHECK(analysis_table().size() == 3);
}

TEST_CASE("keys of statics are read") {
  const auto options = [](const std::string& text) {
    return dynamic_cast<const StaticAnalysis&>(*read(text)).options();
  };
  CHECK(options("{type: static}").steps == 1);
  CHECK(options("{type: static, steps: 5}").steps == 5);
  CHECK(options("{type: static, steps: auto}").steps == 0);
  CHECK(options("{type: static, arc_length: {until: {load_factor: 2}}}").path->end.load_factor == 2);
  CHECK(read("{type: static, steps: 5}")->expected_rows({}) == 6);
  CHECK(read("{type: static, steps: auto}")->expected_rows({}) == 0);
}

TEST_CASE("types that do not exist, or not yet, are refused") {
  CHECK_THAT(refusal("{type: dynamc}"), Contains("did you mean 'dynamic'"));
  CHECK_THAT(refusal("{type: eigen}"),
             Contains("the analysis 'eigen' is not in this version; there are assembly, static and dynamic"));
  CHECK_THAT(refusal("{type: assembly, steps: 2}"), Contains("'steps'") && Contains("the analysis 'assembly'"));
}
