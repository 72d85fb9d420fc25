#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <catch2/catch.hpp>

#include "reduce/common/command_line.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/messages.hpp"

using bielle::CommonOptions;
using bielle::InputError;
using bielle::test::message_of;
using Catch::Matchers::Contains;

namespace test_command_line {
namespace {

struct Parsed {
  bool goes_on = false;
  CommonOptions options;
  std::string input, output;
};

Parsed parse(std::vector<const char*> arguments) {
  Parsed parsed;
  CLI::App app("Reduces a body", "bielle-test");
  app.add_option("input", parsed.input, "The body file")->required();
  app.add_option("-o,--output", parsed.output, "The file to write");
  bielle::add_common_options(app, parsed.options);
  arguments.insert(arguments.begin(), "bielle-test");
  parsed.goes_on = bielle::parse_command_line(app, static_cast<int>(arguments.size()), arguments.data());
  return parsed;
}

std::string why_wrong(const std::vector<const char*>& arguments) {
  return message_of<InputError>([&] { parse(arguments); });
}

}  // namespace

TEST_CASE("Common options have defaults and accept values") {
  const Parsed plain = parse({"body.yaml"});
  CHECK(plain.goes_on);
  CHECK(plain.options.threads == bielle::available_processors());
  CHECK_FALSE(plain.options.quiet);
  const Parsed full = parse({"body.yaml", "-o", "out.h5", "--threads", "3", "--quiet"});
  CHECK(full.input == "body.yaml");
  CHECK(full.output == "out.h5");
  CHECK(full.options.threads == 3);
  CHECK(full.options.quiet);
}

TEST_CASE("Help and version end the program without error") {
  CHECK_FALSE(parse({"--help"}).goes_on);
  CHECK_FALSE(parse({"--version"}).goes_on);
}

TEST_CASE("The message about a wrong command line is one line") {
  CHECK(why_wrong({"body.yaml", "--thread", "3"}) ==
        "'--thread' is not an option; did you mean '--threads'? (see bielle-test --help)");
  CHECK_THAT(why_wrong({"body.yaml", "--quit"}), Contains("did you mean '--quiet'?"));
  CHECK_THAT(why_wrong({"body.yaml", "--ouput=x.h5"}),
             Contains("'--ouput' is not an option; did you mean '--output'?"));
  CHECK_THAT(why_wrong({"body.yaml", "-x"}), Contains("'-x' is not an option; expected one of"));
  CHECK_THAT(why_wrong({"body.yaml", "other.yaml"}), Contains("'other.yaml' is one argument too many"));
  CHECK_THAT(why_wrong({}), Contains("input is required"));
  CHECK_THAT(why_wrong({"body.yaml", "--threads", "0"}), Contains("expected a whole number of at least 1"));
  CHECK_THAT(why_wrong({"body.yaml", "--threads", "two"}), Contains("expected a whole number of at least 1"));
  CHECK_THAT(why_wrong({"body.yaml", "--threads"}), Contains("--threads"));
  for (const char* wrong : {"-x", "--threads", "other"})
    CHECK(why_wrong({"body.yaml", wrong}).find('\n') == std::string::npos);
}

}  // namespace test_command_line
