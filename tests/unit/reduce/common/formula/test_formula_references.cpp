#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/formula/expression.hpp"
#include "reduce/common/formula/formula_references.hpp"
#include "reduce/common/input/yaml_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::ComputationError;
using bielle::Expression;
using bielle::FormulaReference;
using bielle::FormulaText;
using bielle::InputError;
using bielle::YamlValue;
using bielle::test::message_of;
using Catch::Matchers::Contains;

namespace {

using Names = std::vector<std::string>;

FormulaText found(const std::string& text, const Names& plain_names = {"t"}) {
  return bielle::find_references(text, plain_names, {"distance", "angle"});
}
FormulaReference only(const std::string& text) {
  const FormulaText formula = found(text);
  REQUIRE(formula.references.size() == 1);
  return formula.references[0];
}
std::string why(const std::string& text) {
  return message_of<InputError>([&] { found(text); });
}

}  // namespace

TEST_CASE("A dotted reference has a subject and a path") {
  const FormulaReference rate = only("3 + main.angle.rate*t");
  CHECK(rate.text == "main.angle.rate");
  CHECK(rate.function.empty());
  CHECK(rate.subjects == Names{"main"});
  CHECK(rate.path == Names{"angle", "rate"});
  CHECK(rate.position == 4);
  CHECK(rate.identifier == "main_angle_rate");
  CHECK(found("3 + main.angle.rate*t").replaced == "3 + main_angle_rate*t");
  CHECK(found("3 + main.angle.rate*t").written == "3 + main.angle.rate*t");
  CHECK(only("-pin_2.position.x").path == Names{"position", "x"});
  CHECK(only("(a.b1)").path == Names{"b1"});
  CHECK(only("sin.x*sin(t)").subjects == Names{"sin"});
}

TEST_CASE("Names of other characters are quoted") {
  const FormulaReference arm = only("2*'left arm'.angle");
  CHECK(arm.subjects == Names{"left arm"});
  CHECK(arm.path == Names{"angle"});
  CHECK(arm.text == "'left arm'.angle");
  CHECK(arm.identifier == "_left_arm__angle");
  CHECK(only("\"node 1.2\".velocity.z").subjects == Names{"node 1.2"});
  CHECK(only("'Stütze (3, a)'.angle").subjects == Names{"Stütze (3, a)"});
  CHECK(only("'1'.x").identifier == "_1__x");
}

TEST_CASE("Functions of names of entries are references") {
  const FormulaReference distance = only("t - distance(a, 'node 2')/2");
  CHECK(distance.function == "distance");
  CHECK(distance.subjects == Names{"a", "node 2"});
  CHECK(distance.path.empty());
  CHECK(distance.text == "distance(a, 'node 2')");
  CHECK(distance.identifier == "distance_a___node_2__");
  CHECK(found("t - distance(a, 'node 2')/2").replaced == "t - distance_a___node_2__/2");
  CHECK(only("angle( 1 ,b_2 )").subjects == Names{"1", "b_2"});
  CHECK(only("angle(a, b).rate").path == Names{"rate"});
  CHECK(only("distance(a)").subjects == Names{"a"});  // the caller checks their number
  CHECK(found("distances(t) + angle", {"t", "angle"}).references.empty());
  CHECK(only("angle*angle(a, b)").function == "angle");
}

TEST_CASE("Formulas as operands of functions stay texts, with references of their own") {
  const auto found_with_delay = [](const std::string& text) {
    return bielle::find_references(text, {"t"}, {"angle"}, {"delay"});
  };
  const FormulaText formula = found_with_delay("2*delay( main.angle - f(1, 'a)b'.x) , 2*T)^2 + main.angle");
  REQUIRE(formula.references.size() == 2);
  CHECK(formula.references[0].function == "delay");
  CHECK(formula.references[0].subjects == Names{"main.angle - f(1, 'a)b'.x)", "2*T"});
  CHECK(formula.references[1].text == "main.angle");
  CHECK(found_with_delay("delay(delay(x, 1), 2)").references[0].subjects == Names{"delay(x, 1)", "2"});
  CHECK(found_with_delay("delay + delays(1)").references.empty());
  CHECK_THROWS_WITH(found_with_delay("1 + delay(x, (2)"),
                    Contains("the parenthesis of 'delay' at character 5 is not closed"));
  CHECK_THROWS_WITH(found_with_delay("delay(x,)"), Contains("an operand of 'delay' at character 1 is missing"));
  CHECK_THROWS_WITH(found_with_delay("delay (x, 1)"), Contains("must be followed by '('"));
  // Names in operands are renamed like all others.
  CHECK(bielle::rename_in_formula(
            "delay(a.angle + b, T)", {"angle"},
            [](const std::string& name) -> std::optional<std::string> { return "part." + name; },
            [](const std::string& word) -> std::optional<std::string> {
              return word == "b" ? std::optional<std::string>("part.b") : std::nullopt;
            }) == "delay(part.a.angle + part.b, T)");
}

TEST_CASE("Numbers, plain names and names of files are left alone") {
  for (const std::string text :
       {"2.5*t + .5 - 1e-3 + 2.e3 + 1.5e+2", "2.*t", "t .5", "table('file.csv', t)", "spline(\"a b.csv\", t)", "", "  ",
        "sin(t)^2. + r_1", "3..4", "1.t", ".x", "t*(2).x"}) {
    CHECK(found(text).references.empty());
    CHECK(found(text).replaced == text);
  }
  CHECK(found("table('file.csv', main.angle)").replaced == "table('file.csv', main_angle)");
}

TEST_CASE("Each reference is listed once, in the order of the formula, with its place") {
  const FormulaText formula = found("b.x*a.y + b.x^2 + distance(p,  q) - 'a'.y*distance(p, q)");
  REQUIRE(formula.references.size() == 3);
  CHECK(formula.references[0].text == "b.x");
  CHECK(formula.references[1].text == "a.y");
  CHECK(formula.references[2].text == "distance(p,  q)");
  CHECK(formula.references[2].position == 18);
  CHECK(formula.replaced == "b_x*a_y + b_x^2 + distance_p___q  - a_y  *distance_p___q");
  CHECK(found("angle(a, b) + distance(a, b) + angle(b, a)").references.size() == 3);
}

TEST_CASE("The identifier of a reference equals no other name") {
  CHECK(found("a.b + a_b").replaced == "a_0 + a_b");
  CHECK(found("a.b", {"a_b"}).replaced == "a_0");
  CHECK(found("'a'.b + _a__b + _a__0 + 'b'.c").replaced == "_a__1 + _a__b + _a__0 + _b__c");
  const FormulaText many = found("log.x + log_x + log_0+log_1+log_2+log_3+log_4+log_5+log_6+log_7+log_8+log_9");
  CHECK(many.references[0].identifier == "log11");
  const FormulaText same = found("'a b'.c + 'a-b'.c + 'a.b'.c");
  CHECK(same.replaced == "_a_b__c + _a_b__0 + _a_b__1");
  const std::string name(300, 'n');
  CHECK(only("'" + name + "'.x").identifier.size() < 255);
  CHECK(found("'" + name + "'.x + t").replaced.size() == 308);
  std::string crowd = "a.b + a_b";
  for (int i = 0; i < 100; ++i) crowd += " + a" + std::string(i < 10 ? "_" : "") + std::to_string(i);
  CHECK(found(crowd).references[0].identifier == "a100");
}

TEST_CASE("The message about a wrong reference tells its place") {
  CHECK(why("2*main. angle") == "'main. angle' at character 3 is written without blanks at the dots");
  CHECK(why("2*main .angle") == "'main .angle' at character 3 is written without blanks at the dots");
  CHECK(why("'left arm' . angle") == "''left arm' . angle' at character 1 is written without blanks at the dots");
  CHECK(why("t + main.") == "a name is missing after 'main.' at character 5");
  CHECK(why("main.angle.*2") == "a name is missing after 'main.angle.' at character 1");
  CHECK(why("main.2") == "a name is missing after 'main.' at character 1");
  CHECK(why("2*'left arm.angle") == "the quote at character 3 is not closed");
  CHECK(why("''.angle") == "a name is missing in the quotes at character 1");
  CHECK(why("1 + distance(a.1, b)") ==
        "'distance' at character 5 takes names, in quotes if they are more than a word: distance(one, 'number two')");
  for (const std::string text :
       {"angle(", "angle()", "angle(a,", "angle(a, )", "angle(a b)", "angle(a, 2*b)", "angle('', b)"})
    CHECK_THAT(why(text), Contains("'angle' at character 1 takes names"));
  CHECK(why("distance (a, b)") == "the function 'distance' at character 1 must be followed by '('");
}

TEST_CASE("References are further arguments of the formula, and messages use the names of the user") {
  const FormulaText text = found("r*main.angle - t/'left arm'.angle");
  const Expression formula(text, {"t"}, {{"r", 2}});
  CHECK(formula(std::vector<double>{6, 5, 3}) == 8);
  CHECK(formula.text() == "r*main.angle - t/'left arm'.angle");
  CHECK(formula.derivative(std::vector<double>{6, 5, 3}, 1) == 2);
  CHECK(message_of<ComputationError>([&] {
          formula(std::vector<double>{6, 5, 0});
        }) ==
        "formula 'r*main.angle - t/'left arm'.angle' at t = 6, main.angle = 5, 'left arm'.angle = 0: division by zero");

  const auto why_not = [](const std::string& wrong) {
    return message_of<InputError>([&] { Expression(found(wrong), {"t"}); });
  };
  CHECK(why_not("2*main.angle*sqr(t)") ==
        "in '2*main.angle*sqr(t)': unknown name 'sqr' at character 14; did you mean 'sqrt'?");
  CHECK_THAT(why_not("2*main.angle*speed"), Contains("expected one of 't', 'main.angle'; pi; or a function"));
  CHECK_THAT(why_not("2 main.angle"), Contains("unexpected 'main.angle' at character 3: an operator is missing"));
  CHECK_THAT(why_not("main.angle 'left arm'.angle"), Contains("unexpected ''left arm'.angle' at character 12"));
  CHECK_THAT(why_not("t # main.angle"), Contains("'# main.angle' at character 3 is not understood"));
  CHECK_THAT(why_not("t*main.angle(3)"), Contains("at character 13"));
  CHECK_THAT(why_not("sin(main.angle, 2)"), Contains("too many arguments of 'sin'"));
  CHECK_THAT(why_not("main.angle = 3"), Contains("write =="));
}

TEST_CASE("Input files give formulas with references, and messages with their place") {
  const bielle::test::TemporaryFolder folder;
  folder.file("c.csv", "0 1\n1 2\n");
  YamlValue file = YamlValue::load(
      folder.file("model.yaml",
                  "good: \"r*'left arm'.angle + a_b*a.b\"\nslip: \"2*main.\"\nwrong: 3*main.angle*q\nnumber: 2.50\n"
                  "list: [1]\nfile: \"table('c.csv', main.angle)\"\n"));
  file.set_parameters({{"r", 2}, {"a_b", 10}});
  const auto read = [&](const std::string& key) {
    const YamlValue value = file.at(key);
    return value.expression({"t"}, value.formula_text({"t"}, {"distance"}));
  };
  CHECK(read("good")(std::vector<double>{0, 3, 4}) == 46);
  CHECK(read("file")(std::vector<double>{0, 0.5}) == 1.5);
  CHECK(read("number")(0.0) == 2.5);
  CHECK(file.at("number").text() == "2.50");
  const auto why_not = [&](const std::string& key) { return message_of<InputError>([&] { read(key); }); };
  CHECK_THAT(why_not("slip"), Contains("model.yaml:2: slip: in '2*main.': a name is missing after 'main.'"));
  CHECK_THAT(why_not("wrong"), Contains("model.yaml:3: wrong: in '3*main.angle*q': unknown name 'q' at character 14"));
  CHECK_THAT(why_not("list"), Contains("model.yaml:5: list: expected a number or a formula"));
}
