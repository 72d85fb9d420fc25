// Repeated entries, conditions and cases.
#include <catch2/catch.hpp>

#include "tests/unit/mechanism/language/expanded.hpp"

using bielle::test::expanded;
using bielle::test::refusal;
using Catch::Contains;

TEST_CASE("an entry is repeated with its number in names and formulas") {
  const std::string text = expanded(R"yaml(
parameters: {pitch: 0.5}
nodes:
  bay_{k}: {repeat: {count: 3, as: k}, position: [pitch*k, 0, "1 + k"]}
joints:
  knee_{k}: {repeat: {count: 2, as: k}, type: hinge, nodes: ["bay_{k}", "bay_{k+1}"], axis: [0, 1, 0], damping: "k*angle(bay_1, bay_2)"}
)yaml");
  CHECK_THAT(text,
             Contains("bay_1: {position: [pitch*1, 0, 1 + 1]}") && Contains("bay_3: {position: [pitch*3, 0, 1 + 3]}"));
  CHECK_THAT(text, Contains("knee_2: {type: hinge, nodes: [bay_2, bay_3], axis: [0, 1, 0]"));
  CHECK_THAT(text, Contains("2*angle(bay_1, bay_2)"));
  CHECK_THAT(text, !Contains("repeat") && !Contains("bay_4"));
}

TEST_CASE("repetition goes in several directions, begins where it is told to, and may be empty") {
  const std::string text = expanded(R"yaml(
parameters: {none: 0}
nodes:
  "p_{i}_{j}": {repeat: [{count: 2, as: i, from: 0}, {count: 2, as: j}], position: [i, j, 0]}
  "q_{i}": {repeat: {count: none, as: i}}
)yaml");
  CHECK_THAT(text, Contains("p_0_1: {position: [0, 1, 0]}") && Contains("p_1_2: {position: [1, 2, 0]}"));
  CHECK_THAT(text, !Contains("p_2") && !Contains("q_"));
}

TEST_CASE("negative numbers are put in parentheses") {
  CHECK_THAT(expanded("nodes:\n  \"p_{k+2}\": {repeat: {count: 1, as: k, from: -1}, position: [2-k, 0, 0]}\n"),
             Contains("p_1: {position: [2-(-1), 0, 0]}"));
}

TEST_CASE("variables of a formula are not numbers of a repetition") {
  CHECK_THAT(refusal("nodes:\n  a: {repeat: {count: 2, as: t}}\n"),
             Contains("model.yaml:2: nodes.a.repeat") && Contains("'t'"));
  const std::string text = expanded(R"yaml(
elements:
  s_{v}: {repeat: {count: 1, as: v}, type: spring_damper, nodes: [a, b], force: "3*v", at: [[v, 0, 0], [0, 0, 0]]}
)yaml");
  CHECK_THAT(text, Contains("force: 3*v") && Contains("at: [[1, 0, 0]"));
}

TEST_CASE("repetitions that mean nothing are refused where they stand") {
  const auto repeat = [](const std::string& keys) { return refusal("nodes:\n  a: {repeat: {" + keys + "}}\n"); };
  CHECK_THAT(repeat("count: 2, as: k"), Contains("model.yaml:2: nodes.a") && Contains("two entries"));
  CHECK_THAT(repeat("count: 1.5, as: k"), Contains("nodes.a.repeat.count") && Contains("whole number"));
  CHECK_THAT(repeat("count: -1, as: k"), Contains("nodes.a.repeat.count"));
  CHECK_THAT(repeat("count: 1e9, as: k"), Contains("nodes.a.repeat.count"));
  CHECK_THAT(repeat("as: k"), Contains("give the `count`"));
  CHECK_THAT(repeat("count: 2"), Contains("'as' is missing"));
  CHECK_THAT(repeat("count: 2, as: k, form: 1"), Contains("'form'") && Contains("from"));
  CHECK_THAT(repeat("count: 2 m, as: k"), Contains("nodes.a.repeat.count") && Contains("without a unit"));
  CHECK_THAT(repeat("count: 2, as: [k]"), Contains("model.yaml:2: nodes.a.repeat.as: expected a text"));
  for (const std::string name : {"t", "pi", "sin", "a b", "1", "k+1", "k.a", "ä"})
    CHECK_THAT(repeat("count: 2, as: \"" + name + "\""), Contains("nodes.a.repeat.as: '" + name + "'"));
  for (const std::string list : {"", "[]", "{}", "3", "[3]", "[[]]"})
    CHECK_THAT(refusal("nodes:\n  a: {repeat: " + list + "}\n"), Contains("model.yaml:2: nodes.a.repeat: "));
  CHECK_THAT(refusal("nodes:\n  a: {repeat: [{count: 2, as: k}, {count: 3, as: k}]}\n"),
             Contains("nodes.a.repeat.as: 'k' has a meaning"));
  CHECK_THAT(refusal("nodes:\n  a: {repeat: [{count: 2000, as: j}, {count: 2000, as: k}], if: k < 0}\n"),
             Contains("nodes.a.repeat: these are more than 1000000 entries"));
  CHECK_THAT(refusal("nodes:\n  \"a_{k/2}\": {repeat: {count: 1, as: k}}\n"), Contains("{k/2}") && Contains("0.5"));
  CHECK_THAT(refusal("nodes:\n  \"a_{k\": {repeat: {count: 1, as: k}}\n"), Contains("not closed"));
  CHECK_THAT(refusal("nodes:\n  \"a_{m}\": {repeat: {count: 1, as: k}}\n"), Contains("'m'"));
}

TEST_CASE("an entry is there if its condition holds") {
  const std::string text = R"yaml(
parameters: {drop: 1, height: 0}
nodes:
  a: {if: drop}
  b: {if: height}
  c: {if: "drop > 0 && height < 1"}
  d: {if: false}
  "e_{k}": {if: "k != 2", repeat: {count: 3, as: k}}
)yaml";
  const std::string written = expanded(text);
  CHECK_THAT(written, Contains("a: ") && !Contains("b: ") && Contains("c: ") && !Contains("d: ") && Contains("e_1") &&
                          !Contains("e_2") && Contains("e_3"));
  CHECK_THAT(refusal("nodes:\n  a: {if: dorp}\n"), Contains("model.yaml:2: nodes.a.if") && Contains("dorp"));
  for (const std::string value : {"", "[]", "{}", "nan", "0/0", "5 deg", "no"})
    CHECK_THAT(refusal("nodes:\n  a: {if: " + value + "}\n"), Contains("model.yaml:2: nodes.a.if: "));
}

TEST_CASE("a case replaces parameters and analyses") {
  const std::string text = R"yaml(
parameters: {speed: 1, height: "2*speed"}
nodes: {a: {}}
analysis: [{type: static}]
cases:
  drop: {parameters: {speed: 3}, analysis: [{type: eigen, count: 2}]}
  slow: {parameters: {speed: 0.1}}
)yaml";
  CHECK_THAT(expanded(text), Contains("speed: 1") && Contains("static") && !Contains("cases"));
  CHECK_THAT(expanded(text, "drop"), Contains("speed: 3") && Contains("eigen") && !Contains("static"));
  CHECK_THAT(expanded(text, "slow"), Contains("speed: 0.1") && Contains("static"));
  CHECK_THAT(refusal(text, "slwo"), Contains("slow"));
  CHECK_THAT(refusal("nodes: {a: {}}\ncases:\n  c: {parameters: {x: 1}}\n", "c"),
             Contains("model.yaml:3: cases.c.parameters") && Contains("'x'"));
  for (const std::string wrong :
       {"c: 3", "c: []", "c: {gravity: [0, 0, 1]}", "c: {parameters: []}", "c: {parameters: {x: 1}}"})
    CHECK_THAT(refusal("nodes: {a: {}}\ncases:\n  " + wrong + "\n"), Contains("model.yaml:3: cases.c"));
  CHECK_THAT(refusal("nodes: {a: {}}\ncases:\n  a/b: {}\n"),
             Contains("model.yaml:3: cases: 'a/b' is no name of a case"));
  CHECK_THAT(refusal("cases:\n  c: {parameters: {x: }}\nparameters: {x: 1}\n", "c"),
             Contains("model.yaml:2: parameters.x: expected a number"));
  CHECK_THAT(refusal("nodes: {a: {}}\ncases:\n  c: {prameters: {x: 1}}\n", "c"), Contains("parameters"));
}

TEST_CASE("an entry is repeated over words, which stand in its names and texts") {
  const std::string text = R"yaml(
nodes:
  "{side}_{k}": {repeat: [{over: [left, right], as: side}, {count: 2, as: k}], position: [k, 0, 0]}
elements:
  "body_{side}": {repeat: {over: [left, right], as: side}, type: point_mass, node: "{side}_2", mass: 1}
measures:
  "{side}_height": {repeat: {over: [left, right], as: side}, formula: "{side}_1.position.z"}
)yaml";
  const std::string written = expanded(text);
  for (const char* expected : {"left_1: {position: [1, 0, 0]", "right_2: {position: [2, 0, 0]", "node: right_2",
                               "left_height: {formula: left_1.position.z"})
    CHECK_THAT(written, Contains(expected));
}

TEST_CASE("words that are numbers stand in formulas as well") {
  const std::string written =
      expanded("nodes:\n  'n_{a}': {repeat: {over: [-1, 2.5], as: a}, position: [2*a, 0, 0]}\n");
  CHECK_THAT(written, Contains("n_-1: {position: [2*(-1), 0, 0]") && Contains("n_2.5: {position: [2*2.5, 0, 0]"));
}

TEST_CASE("a repetition goes either over words or over a count") {
  const auto refused = [](const std::string& repeat) {
    return refusal("nodes:\n  'n{k}': {repeat: " + repeat + "}\n");
  };
  CHECK_THAT(refused("{as: k}"),
             Contains("model.yaml:2: nodes.n{k}.repeat") && Contains("`count`") && Contains("`over`"));
  CHECK_THAT(refused("{as: k, over: [a], count: 2}"), Contains("nodes.n{k}.repeat") && Contains("do not go with it"));
  CHECK_THAT(refused("{as: k, over: [a], from: 2}"), Contains("do not go with it"));
  CHECK_THAT(refused("{as: k, over: 3}"), Contains("expected a list"));
  CHECK_THAT(refused("{as: k, over: [[a]]}"), Contains("expected a text"));
  CHECK_THAT(refused("{as: k, over: [a, a]}"), Contains("nodes.na") && Contains("two entries with this name"));
  CHECK(expanded("nodes: {a: {}, 'n{k}': {repeat: {as: k, over: []}}}\n").find("n{k}") == std::string::npos);
}

TEST_CASE("a file without the language is left as it is") {
  using namespace bielle::mechanism;
  const auto tree = bielle::parse_yaml("nodes: {'a{b': {position: [0, 0, 0]}}", "model.yaml");
  const ExpandedModel model = expand_model(tree, "model.yaml", mechanism_file_keys(), {});
  CHECK(model.root == tree);
  CHECK_FALSE(model.is_changed);
}
