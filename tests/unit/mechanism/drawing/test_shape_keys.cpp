// Wrong values of `shape` are refused in one sentence with file, line and key.
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mechanism/drawing/drawn_model.hpp"

namespace test_shape_keys {

using namespace bielle;
using namespace bielle::mechanism;
using namespace bielle::test;
using Catch::Contains;

std::string refusal(const std::string& shape) {
  const std::string text =
      "nodes: {a: {}}\nelements:\n  it: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1],\n       shape: " +
      shape + "}\n";
  return message_of<InputError>([&] { read_mechanism_text(text, "model.yaml"); });
}

TEST_CASE("wrong sizes of shapes are refused") {
  for (const auto& [shape, says] : std::vector<std::pair<std::string, std::string>>{
           {"{box: [1, 2]}", "box"},
           {"{box: [1, 2, 0]}", "greater than 0"},
           {"{box: [1, -2, 1]}", "greater than 0"},
           {"{box: [1, .nan, 1]}", "box"},
           {"{box: [1, .inf, 1]}", "box"},
           {"{box: 1}", "box"},
           {"{box: {a: 1}}", "box"},
           {"{box: []}", "box"},
           {"{box: ~}", "box"},
           {"{sphere: 0}", "greater than 0"},
           {"{sphere: [1]}", "sphere"},
           {"{sphere: big}", "big"},
           {"{cylinder: [1, 0]}", "greater than 0"},
           {"{cylinder: [1, 2, 3]}", "[radius, length]"},
           {"{tube: [1, 1, 1]}", "smaller than the outer one"},
           {"{tube: [1, -1, 1]}", "at least 0"},
           {"{cone: [0, 0, 1]}", "greater than 0"},
           {"{ring: [1, 2]}", "must not exceed"},
           {"{sphere: 1, opacity: 1.5}", "between 0 and 1"},
           {"{sphere: 1, opacity: -0.1}", "between 0 and 1"},
           {"{sphere: 1, opacity: dim}", "dim"},
           {"{sphere: 1, position: [1, 2]}", "position"},
           {"{sphere: 1, quaternion: [0, 0, 0, 0]}", "quaternion"},
           {"{sphere: 1, euler: [0, 0, 0], matrix: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}", "matrix"}}) {
    CAPTURE(shape);
    const std::string said = refusal(shape);
    CHECK_THAT(said, Contains("model.yaml:4: elements.it.shape"));
    CHECK_THAT(said, Contains(says));
  }
}

TEST_CASE("shapes have exactly one form, and known keys and colours") {
  for (const auto& [shape, says] : std::vector<std::pair<std::string, std::string>>{
           {"{}", "expected exactly one of 'box', 'sphere'"},
           {"{colour: red}", "expected exactly one of"},
           {"{box: [1, 1, 1], sphere: 1}", "expected exactly one of"},
           {"[]", "at least"},
           {"[{sphere: 1}, {cone: [1, 1]}]", "cone"},
           {"5", "shape"},
           {"box", "shape"},
           {"{spere: 1}", "did you mean 'sphere'?"},
           {"{sphere: 1, color: red}", "did you mean 'colour'?"},
           {"{sphere: 1, density: 7800}", "'density' is not a key of a shape"},
           {"{sphere: 1, cut: true}", "'cut' is not a key of a shape"},
           {"{sphere: 1, scale: 2}", "belongs to an STL file"},
           {"{sphere: 1, colour: steelblu}", "did you mean 'steelblue'?"},
           {"{sphere: 1, colour: '#12345'}", "#rrggbb"},
           {"{sphere: 1, colour: '#12345g'}", "#rrggbb"},
           {"{sphere: 1, colour: '#1234567'}", "#rrggbb"},
           {"{sphere: 1, colour: ''}", "colour"},
           {"{sphere: 1, colour: [1, 0, 0]}", "colour"}}) {
    CAPTURE(shape);
    const std::string said = refusal(shape);
    CHECK_THAT(said, Contains("model.yaml:4: elements.it.shape"));
    CHECK_THAT(said, Contains(says));
  }
}

TEST_CASE("files of shapes that are missing or damaged are refused") {
  const TemporaryFolder folder;
  folder.file("text.stl", "no triangles here");
  folder.file("empty.stl", "");
  folder.file("nan.stl", "solid x\nvertex nan 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
  folder.file("good.stl", "solid x\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
  const auto said = [&](const std::string& shape) {
    const std::string text =
        "nodes: {a: {shape: " + shape + "}}\nelements: {it: {type: point_mass, node: a, mass: 1}}\n";
    return message_of<InputError>([&] { read_mechanism_text(text, folder / "model.yaml"); });
  };
  CHECK(said("{stl: good.stl}") == "(nothing thrown)");
  for (const std::string name : {"missing.stl", "text.stl", "empty.stl", "nan.stl", "."}) {
    CAPTURE(name);
    CHECK_THAT(said("{stl: " + name + "}"), Contains("model.yaml:1: nodes.a.shape.stl"));
  }
  CHECK_THAT(said("{stl: good.stl, scale: 0}"), Contains("nodes.a.shape.scale") && Contains("greater than 0"));
  CHECK_THAT(said("{stl: good.stl, scale: 1e300}"), Contains("nodes.a.shape.stl") && Contains("too large"));
  CHECK_THAT(said("{stl: 5}"), Contains("nodes.a.shape.stl"));
  CHECK_THAT(said("{step: part.step}"), Contains("nodes.a.shape.step") && Contains("part.step"));
}

}  // namespace test_shape_keys
