// Tests of the lines of keys in a body file, for messages that arise after it was read.
#include <catch2/catch.hpp>

#include "reduce/body_file/key_lines.hpp"
#include "reduce/common/input/yaml_file.hpp"

using namespace bielle;
using bielle::reduce::KeyLines;

namespace test_key_lines {
namespace {

const char* const text =
    "geometry: rod.geo\n"                             // 1
    "interfaces:\n"                                   // 2
    "  big_end: {surface: bore, tie: rigid}\n"        // 3
    "  small.end:\n"                                  // 4
    "    tie: average\n"                              // 5
    "    surface: [bore,\n"                           // 6
    "              {box: [[0, 0, 0], [1, 1, 1]]}]\n"  // 7
    "inertia_relief:\n"                               // 8
    "modes:\n"                                        // 9
    "  count: 20\n";                                  // 10

std::string line_of(const std::string& subject) {
  return KeyLines(YamlValue::parse(text, "models/rod.yaml")).located(subject, "wrong");
}

}  // namespace

TEST_CASE("the line of a key is that of its value") {
  CHECK(line_of("geometry") == "models/rod.yaml:1: wrong");
  CHECK(line_of("interfaces.big_end") == "models/rod.yaml:3: wrong");
  CHECK(line_of("interfaces.small.end") == "models/rod.yaml:5: wrong");
  CHECK(line_of("interfaces.small.end.surface") == "models/rod.yaml:6: wrong");
  CHECK(line_of("interfaces.small.end.surface[2]") == "models/rod.yaml:7: wrong");
  CHECK(line_of("inertia_relief") == "models/rod.yaml:8: wrong");
  CHECK(line_of("modes") == "models/rod.yaml:10: wrong");
}

TEST_CASE("a key that is not in the file has the line of the innermost key around it") {
  CHECK(line_of("interfaces.big_end.position") == "models/rod.yaml:3: wrong");
  CHECK(line_of("interfaces.small.end.surface[3].cylinder.radius") == "models/rod.yaml:6: wrong");
  CHECK(line_of("modes.below") == "models/rod.yaml:10: wrong");
}

TEST_CASE("without a key around it, a message has no line") {
  CHECK(line_of("damping.ratio") == "wrong");
  CHECK(line_of("") == "wrong");
  CHECK(KeyLines().located("modes", "wrong") == "wrong");
}

TEST_CASE("the line of a key is the one that the reader of the file finds") {
  const YamlValue file = YamlValue::parse(text, "rod.yaml");
  const YamlValue surface = file.at("interfaces").at("small.end").at("surface");
  for (const YamlValue& value : {file.at("modes"), file.at("inertia_relief"), surface, surface.at(1).at("box")})
    CHECK(KeyLines(file).located(value.path(), value.path() + ": wrong") == value.located("wrong"));
}

}  // namespace test_key_lines
