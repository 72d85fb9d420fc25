#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/common/input/yaml_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::InputError;
using bielle::YamlValue;
using bielle::test::message_of;
using Catch::Matchers::Contains;

namespace test_yaml_file {
namespace {

YamlValue parsed(const std::string& text) { return YamlValue::parse(text, "crank.yaml"); }
std::string why_wrong(const std::string& text) {
  return message_of<InputError>([&] { parsed(text); });
}
template <class Action>
std::string why(Action&& action) {
  return message_of<InputError>(action);
}

}  // namespace

TEST_CASE("Values are found by key and index, with their place in the file") {
  const YamlValue file = parsed("# a comment\njoints:\n  main:\n    axis: [0, 0, 1]\n    nodes: [a, b]\n");
  const YamlValue axis = file.at("joints").at("main").at("axis");
  CHECK(axis.line() == 4);
  CHECK(axis.path() == "joints.main.axis");
  CHECK(axis.at(2).path() == "joints.main.axis[3]");
  CHECK(axis.file() == "crank.yaml");
  CHECK(axis.size() == 3);
  CHECK(file.at("joints").at("main").at("nodes").items()[1].text() == "b");
  CHECK(file.has("joints"));
  CHECK_FALSE(file.find("drives"));
  CHECK(axis.located("a message") == "crank.yaml:4: joints.main.axis: a message");
  CHECK(file.source_text().starts_with("# a comment"));
}

TEST_CASE("Entries come in the order of the file") {
  std::string keys;
  const YamlValue file = parsed("z: 1\na: 2\nm: 3\n");
  for (const auto& [key, value] : file.entries()) keys += key + value.text();
  CHECK(keys == "z1a2m3");
}

TEST_CASE("A missing or unreadable file gives a message of one sentence") {
  const bielle::test::TemporaryFolder folder;
  CHECK_THAT(why([&] { YamlValue::load(folder / "none.yaml"); }), Contains("none.yaml: there is no such file"));
  CHECK_THAT(why([&] { YamlValue::load(folder.path()); }), Contains("is a folder"));
  CHECK_THAT(why([&] { YamlValue::load(folder.file("empty.yaml", "")); }), Contains("the file is empty"));
  CHECK_THAT(why([&] { YamlValue::load(folder.file("comment.yaml", "# nothing\n")); }), Contains("the file is empty"));
}

TEST_CASE("Invalid YAML gives a message with its line") {
  CHECK_THAT(why_wrong("a: 1\nb: [1, 2\nc: 3\n"), Contains("crank.yaml:3: no valid YAML"));
  CHECK_THAT(why_wrong("a: 1\n\tb: 2\n"), Contains("crank.yaml:2: no valid YAML"));
  CHECK_THAT(why_wrong("a:\n  \tb: 2\n"), Contains("(line 2 begins with a tab; YAML wants spaces there)"));
  CHECK_THAT(why_wrong("a: [1\tb: {"), !Contains("tab"));
  CHECK_THAT(why_wrong("a: *nowhere\n"), Contains("crank.yaml:1: no valid YAML"));
  CHECK_THAT(why_wrong("a: 1\n---\nb: 2\n"), Contains("crank.yaml:3: a second document"));
  CHECK_THAT(why_wrong("a: &x {b: 1}\n---\n*x\n"), Contains("crank.yaml:3: a second document"));
}

TEST_CASE("Tags, bytes that are not text, and deep nesting are refused with their line") {
  CHECK(why_wrong("a: 1\nb: !include c.yaml\n") == "crank.yaml:2: tags ('!include') are not supported");
  CHECK(parsed("a: !!str 5\n").at("a").number() == 5);
  CHECK_THAT(why_wrong("a: 1\nb: \xff\n"), Contains("crank.yaml:2: no valid YAML: invalid leading UTF-8 octet"));
  CHECK_THAT(why_wrong("\x89HDF\r\n"), Contains("crank.yaml: this is an HDF5 file"));
  CHECK_THAT(why_wrong("ISO-10303-21: ["), Contains("this is a STEP file"));
  CHECK_THAT(why_wrong("a: 1\nb: \x01\n"), Contains("crank.yaml:2: no valid YAML: control characters"));
  CHECK_THAT(why_wrong("a: " + std::string(51, '[')), Contains("crank.yaml:1: nested more than 50 levels deep"));
  CHECK_THAT(why_wrong("a: " + std::string(50'000, '[')), Contains("nested more than 50 levels deep"));
  CHECK_THAT(why_wrong("a: " + std::string(50, '[')), Contains("no valid YAML: while parsing a flow"));
  std::string laughs = "a0: &a0 [x, x]\n";
  for (int k = 1; k < 30; ++k) laughs += fmt::format("a{0}: &a{0} [*a{1}, *a{1}]\n", k, k - 1);
  CHECK_THAT(why_wrong(laughs), Contains("aliases (`*name`) repeat more than 100000 values"));
}

TEST_CASE("An empty value, ~ and null are null; quoted ones are texts") {
  const YamlValue file = parsed("list: [~, null, 'null', '', \"~\"]\n");
  CHECK(file.at("list").at(0).is_null());
  CHECK(file.at("list").at(1).is_null());
  for (const std::size_t k : {2, 3, 4}) CHECK(file.at("list").at(k).is_scalar());
  CHECK_THAT(why_wrong("~: 1\n"), Contains("a key must be a word"));
}

TEST_CASE("Duplicate keys, merge keys and keys that are not words are refused at any depth") {
  CHECK_THAT(why_wrong("a: 1\nb: 2\na: 3\n"), Contains("crank.yaml:3: a: this key stands here twice; first on line 1"));
  CHECK_THAT(why_wrong("list:\n  - {x: 1}\n  - {y: 1,\n     y: 2}\n"), Contains("crank.yaml:4: list[2].y: this key"));
  CHECK_THAT(why_wrong("base: &b {x: 1}\nother:\n  <<: *b\n  y: 2\n"), Contains("crank.yaml:3: other: '<<'"));
  CHECK_THAT(why_wrong("a:\n  [1, 2]: 3\n"), Contains("crank.yaml:2: a: a key must be a word"));
  CHECK_THAT(why_wrong("a: &a\n  b: *a\n"), Contains("an anchor contains itself"));
  CHECK(parsed("base: &b {x: 1}\nother: *b\n").at("other").at("x").number() == 1);
}

TEST_CASE("An empty value is a map without keys, at the line of its key") {
  const YamlValue file = parsed("a: 1\nempty:\n\n\nb: 2\nlast:\n");
  const YamlValue empty = file.at("empty");
  CHECK(empty.is_null());
  CHECK(empty.line() == 2);
  CHECK(empty.entries().empty());
  CHECK_FALSE(empty.has("x"));
  CHECK_NOTHROW(empty.check_keys({"x"}, "a thing"));
  CHECK(file.at("last").line() == 6);
  CHECK(why([&] { empty.number(); }) == "crank.yaml:2: empty: expected a number, found nothing");
  CHECK(why([&] { empty.at("x"); }) == "crank.yaml:2: empty: the key 'x' is missing");
}

TEST_CASE("Unknown keys are refused with the nearest one") {
  const YamlValue main = parsed("joints:\n  main:\n    type: hinge\n    dampng: 3\n").at("joints").at("main");
  CHECK(why([&] {
          main.check_keys({"type", "damping"}, "a hinge");
        }) == "crank.yaml:4: joints.main: 'dampng' is not a key of a hinge; did you mean 'damping'?");
  CHECK_NOTHROW(main.check_keys({"type", "dampng"}, "a hinge"));
  CHECK_THAT(why([&] {
               parsed("{mass: 1,5}").check_keys({"mass", "node"}, "a body");
             }),
             Contains("'5' is not a key of a body; a comma separates keys: decimals are written with a point (1.5)"));
  CHECK(why([&] { main.at("type").check_keys({"x"}, "a hinge"); }) ==
        "crank.yaml:3: joints.main.type: expected a hinge as keys with values (`key: value`)");
}

TEST_CASE("Numbers are plain or formulas of the parameters") {
  YamlValue file = parsed("a: 2\nb: 1.5e3\nc: \"2*pi\"\nd: 2*r\ne: -.5\nf: +7\ng: 1e3*r\n");
  file.set_parameters({{"r", 0.25}});
  CHECK(file.parameters().at("r") == 0.25);
  CHECK(file.at("a").number() == 2);
  CHECK(file.at("b").number() == 1500);
  CHECK(file.at("c").number() == 2 * 3.14159265358979323846);
  CHECK(file.at("d").number() == 0.5);
  CHECK(file.at("e").number() == -0.5);
  CHECK(file.at("f").number() == 7);
  CHECK(file.at("g").number() == 250);
}

TEST_CASE("Values that are not finite numbers are refused with their place") {
  const YamlValue file = parsed("a: x2\nb: [1]\nc: .inf\nd: .nan\ne: 1/0\nf: 1,5\ng: true\nh: ''\ni: 1e999\nj: inf\n");
  CHECK_THAT(why([&] { file.at("a").number(); }), Contains("crank.yaml:1: a: in 'x2': unknown name 'x2'"));
  CHECK_THAT(why([&] { file.at("b").number(); }), Contains("crank.yaml:2: b: expected a number"));
  CHECK_THAT(why([&] { file.at("c").number(); }), Contains("expected a finite number, found '.inf'"));
  CHECK_THAT(why([&] { file.at("d").number(); }), Contains("expected a finite number, found '.nan'"));
  CHECK_THAT(why([&] { file.at("e").number(); }), Contains("division by zero"));
  CHECK_THAT(why([&] { file.at("f").number(); }), Contains("a decimal point is written '.'"));
  CHECK_THAT(why([&] { file.at("g").number(); }), Contains("unknown name 'true'"));
  CHECK_THAT(why([&] { file.at("h").number(); }), Contains("the formula is empty"));
  CHECK_THAT(why([&] { file.at("i").number(); }), Contains("too large"));
  CHECK_THAT(why([&] { file.at("j").number(); }), Contains("expected a finite number"));
}

TEST_CASE("Messages about bounded numbers, whole numbers and truth values tell the expected value") {
  const YamlValue file =
      parsed("zero: 0\nminus: -1\nhalf: 0.5\nseven: \"3+4\"\nbig: 3e9\nyes: true\nno: False\nmaybe: yes\n");
  CHECK(why([&] { file.at("zero").positive_number(); }) ==
        "crank.yaml:1: zero: expected a number greater than 0, found 0");
  CHECK(file.at("zero").non_negative_number() == 0);
  CHECK_THAT(why([&] { file.at("minus").non_negative_number(); }), Contains("at least 0, found -1"));
  CHECK_THAT(why([&] { file.at("half").integer(); }), Contains("expected a whole number, found 0.5"));
  CHECK_THAT(why([&] { file.at("big").integer(); }), Contains("expected a whole number"));
  CHECK(file.at("seven").integer() == 7);
  CHECK(file.at("minus").integer() == -1);
  CHECK(file.at("yes").boolean());
  CHECK_FALSE(file.at("no").boolean());
  CHECK_THAT(why([&] { file.at("maybe").boolean(); }), Contains("expected true or false, found 'yes'"));
}

TEST_CASE("A word must be one of those allowed") {
  const YamlValue file = parsed("type: hing\nother: [a]\n");
  CHECK(why([&] {
          file.at("type").word({"hinge", "screw"}, "a joint type");
        }) == "crank.yaml:1: type: 'hing' is not a joint type; did you mean 'hinge'?");
  CHECK(file.at("type").word({"hing"}, "a joint type") == "hing");
  CHECK_THAT(why([&] {
               file.at("other").word({"hinge", "screw"}, "a joint type");
             }),
             Contains("expected a joint type as one word; expected one of 'hinge', 'screw'"));
}

TEST_CASE("Vectors, directions and matrices must have the requested shape") {
  YamlValue file =
      parsed("v: [1, \"r\", 3]\nm: [[1, 2, 3], [4, 5, 6]]\nzero: [0, 0, 0]\ntwo: [1, 2]\nragged: [[1, 2], [3]]\n");
  file.set_parameters({{"r", 2}});
  CHECK(file.at("v").vector3() == Eigen::Vector3d(1, 2, 3));
  CHECK(file.at("v").vector() == Eigen::VectorXd(Eigen::Vector3d(1, 2, 3)));
  CHECK(file.at("two").vector().size() == 2);
  CHECK((file.at("v").direction() - Eigen::Vector3d(1, 2, 3) / std::sqrt(14.0)).norm() < 1e-15);
  CHECK(file.at("m").matrix(2, 3)(1, 0) == 4);
  CHECK_THAT(why([&] { file.at("two").vector3(); }), Contains("expected a list of three numbers"));
  CHECK_THAT(why([&] { parsed("v: [max(1, 2), 3, 4]").at("v").vector3(); }),
             Contains("found 4; decimals are written with a point, formulas with commas in quotes"));
  CHECK_THAT(why([&] { file.at("zero").direction(); }), Contains("a direction must not be zero"));
  CHECK_THAT(why([&] { file.at("m").matrix(3, 3); }), Contains("expected 3 rows of 3 numbers"));
  CHECK_THAT(why([&] { file.at("ragged").matrix(2, 2); }), Contains("ragged[2]: expected 2 rows of 2 numbers"));
  CHECK_THAT(why([&] { file.at("v").at(0).vector(); }), Contains("expected a list of numbers"));
  CHECK_THAT(why([&] { file.at("v").at(5); }), Contains("expected at least 6 items, found 3"));
  CHECK_THAT(why([&] { file.at("v").entries(); }), Contains("expected keys with values"));
  CHECK_THAT(why([&] { file.text(); }), Contains("crank.yaml:1: expected a text"));
}

TEST_CASE("Formulas of variables keep the parameters and their place") {
  YamlValue file = parsed("torque: 3*t + r\nwrong: 3*tt\n");
  file.set_parameters({{"r", 2}});
  CHECK(file.at("torque").expression({"t"})(2.0) == 8);
  CHECK_THAT(why([&] { file.at("wrong").expression({"t"}); }),
             Contains("crank.yaml:2: wrong: in '3*tt': unknown name 'tt'"));
  CHECK_THAT(why([&] { file.expression({"t"}); }), Contains("expected a number or a formula"));
}

TEST_CASE("File names are relative to the input file") {
  const bielle::test::TemporaryFolder folder;
  const YamlValue file =
      YamlValue::load(folder.file("model.yaml", "f: ../x/rod.h5\ng: /abs/rod.h5\nh: ''\nt: table('c.csv', t)\n"));
  CHECK(file.at("f").file_path() == std::filesystem::path(folder / "../x/rod.h5").lexically_normal().string());
  CHECK(file.at("g").file_path() == "/abs/rod.h5");
  CHECK_THAT(why([&] { file.at("h").file_path(); }), Contains("expected the name of a file"));
  CHECK(YamlValue::parse("f: rod.h5\n", "model.yaml").at("f").file_path() == "rod.h5");
  folder.file("c.csv", "0 1\n1 2\n");
  CHECK(file.at("t").expression({"t"})(0.5) == 1.5);
}

TEST_CASE("A digest depends on the values, not on how they are written") {
  using Digest = std::vector<std::pair<std::string, std::string>>;
  const bielle::test::TemporaryFolder folder;
  folder.file("c.csv", "0 1\n1 2\n");
  const auto digest = [&](const std::string& text) {
    YamlValue file = YamlValue::load(folder.file("model.yaml", text));
    file.set_parameters({{"k", 3}, {"unused", 4}});
    return file.digest({"output"});
  };
  CHECK(
      digest("a: {b: 1e3, c: [+1.50, 2*k*t]}\nd: {}\ne: []\nf:\noutput: 7\n") ==
      Digest{
          {"a.b", "1000"}, {"a.c[1]", "1.5"}, {"a.c[2]", "2*k*t (k = 3)"}, {"d", "{}"}, {"e", "[]"}, {"f", "nothing"}});
  CHECK(digest("a: 1000.0 # m\n") == digest("a: '1e3'\noutput: 8\n"));
  CHECK(digest("a: arm.k\n") == Digest{{"a", "arm.k"}});  // measure k of `arm`, not the parameter k
  const Digest before = digest("a: c.csv\nb: table('c.csv', t)\n");
  CHECK(before == digest("a: c.csv\nb: table('c.csv', t)\n"));
  CHECK_THAT(before[0].second, Contains("c.csv (contents "));
  folder.file("c.csv", "0 1\n1 3\n");
  const Digest after = digest("a: c.csv\nb: table('c.csv', t)\n");
  CHECK(before[0].second != after[0].second);
  CHECK(before[1].second != after[1].second);
}

}  // namespace test_yaml_file
