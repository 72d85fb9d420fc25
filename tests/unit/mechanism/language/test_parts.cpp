// Parts: names, parameters, connections.
#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mechanism/language/expanded.hpp"

using bielle::test::expanded;
using bielle::test::refusal;
using Catch::Contains;

namespace {

const std::string arm = R"yaml(
parameters: {g: 9.81}
nodes: {hub: {}}
definitions:
  arm:
    parameters: {length: 1, mass: "2*length"}
    nodes:
      root: {}
      tip: {position: [length, 0, 0]}
    elements:
      body: {type: rigid_body, node: root, mass: mass, inertia: [1, 1, 1], also: [tip]}
      spring: {type: spring_damper, nodes: [tip, ground], force: "e*mass + sag*g + 'tip'.position.z"}
    joints:
      knee: {type: hinge, nodes: [root, tip], axis: [0, 1, 0]}
    drives:
      motor: {joint: knee, motion: t}
    measures:
      sag: "tip.position.z + distance(root, tip)"
)yaml";

}  // namespace

TEST_CASE("names of a part are those of the part, with its own name before them") {
  const std::string text = expanded(arm + "parts: {left: {part: arm}}\n");
  CHECK_THAT(text, Contains("left.root: {}") && Contains("left.tip: {position: [1, 0, 0]}"));
  CHECK_THAT(text, Contains("left.body: {type: rigid_body, node: left.root, mass: 2") && Contains("also: [left.tip]"));
  CHECK_THAT(text, Contains("nodes: [left.tip, ground]"));
  CHECK_THAT(text, Contains("e*2 + left.sag*g + left.tip.position.z"));
  CHECK_THAT(text, Contains("left.motor: {joint: left.knee"));
  CHECK_THAT(text, Contains("left.sag: left.tip.position.z + distance(left.root, left.tip)"));
  CHECK_THAT(text, Contains("hub: {}") && !Contains("definitions") && !Contains("parts"));
}

TEST_CASE("parameters of a part have the values of its place") {
  const std::string text = expanded(arm + R"yaml(
parts:
  short: {part: arm, parameters: {length: 0.5}}
  "row_{k}": {part: arm, repeat: {count: 2, as: k}, parameters: {length: "10*k"}}
)yaml");
  CHECK_THAT(text, Contains("short.tip: {position: [0.5, 0, 0]}") &&
                       Contains("short.body: {type: rigid_body, node: short.root, mass: 1"));
  CHECK_THAT(text, Contains("row_2.tip: {position: [20, 0, 0]}") &&
                       Contains("row_2.body: {type: rigid_body, node: row_2.root, mass: 40"));
  CHECK_THAT(refusal(arm + "parts: {a: {part: arm, parameters: {lenght: 1}}}\n"),
             Contains("'lenght'") && Contains("length"));
}

TEST_CASE("a node of a part may be one of the model") {
  const std::string text = expanded(arm + "parts: {left: {part: arm, at: hub, merge: {root: hub}}}\n");
  CHECK_THAT(text, !Contains("left.root") && Contains("node: hub") && Contains("distance(hub, left.tip)"));
  CHECK_THAT(refusal(arm + "parts: {a: {part: arm, merge: {tip: hub}}}\n"),
             Contains("parts.a.merge") && Contains("same place") && Contains("(1, 0, 0)"));
  CHECK_THAT(refusal(arm + "parts: {a: {part: arm, merge: {tpi: hub}}}\n"), Contains("'tpi'") && Contains("tip"));
  CHECK_THAT(refusal(arm + "parts: {a: {part: arm, merge: {root: hbu}}}\n"), Contains("'hbu'") && Contains("hub"));
}

TEST_CASE("parts contain parts") {
  const std::string text = expanded(arm + R"yaml(
  pair:
    parameters: {reach: 3}
    parts:
      a: {part: arm, parameters: {length: reach}}
      b: {part: arm, position: [reach, 0, 0]}
    joints:
      between: {type: spherical, nodes: [a.tip, b.root]}
    measures: {gap: "distance(a.tip, b.tip) + a.sag"}
parts: {both: {part: pair, parameters: {reach: 2}}}
)yaml");
  CHECK_THAT(text, Contains("both.a.tip: {position: [2, 0, 0]}") && Contains("both.b.root: {position: [2, 0, 0]}"));
  CHECK_THAT(text, Contains("both.between: {type: spherical, nodes: [both.a.tip, both.b.root]}"));
  CHECK_THAT(text, Contains("distance(both.a.tip, both.b.tip) + both.a.sag"));
}

TEST_CASE("a file is a part, or contains parts") {
  const bielle::test::TemporaryFolder folder;
  folder.file("blade.yaml", "gravity: [0, 0, -1]\nnodes: {root: {}}\nanalysis: [{type: static}]\n");
  folder.file("parts.yaml", arm);
  const auto model = [&](const std::string& text) { return expanded(text, "", folder / "model.yaml"); };
  const std::string text = model("parts: {one: {file: blade.yaml}, two: {file: parts.yaml, part: arm}}\n");
  CHECK_THAT(text, Contains("one.root: {}") && Contains("two.tip:") && !Contains("gravity") && !Contains("static"));
  CHECK_THAT(bielle::test::message_of<bielle::InputError>([&] { model("parts: {one: {file: none.yaml}}\n"); }),
             Contains("model.yaml:1: parts.one.file") && Contains("no such file"));
  CHECK_THAT(
      bielle::test::message_of<bielle::InputError>([&] { model("parts: {one: {file: parts.yaml, part: amr}}\n"); }),
      Contains("'amr'") && Contains("arm"));
}

TEST_CASE("parts that cannot be placed are refused where they stand") {
  CHECK_THAT(refusal(arm + "parts: {a: {}}\n"), Contains("parts.a") && Contains("`part`"));
  CHECK_THAT(refusal(arm + "parts: {a: {part: ram}}\n"), Contains("'ram'") && Contains("arm"));
  CHECK_THAT(refusal(arm + "parts: {a: {part: arm, att: hub}}\n"), Contains("'att'") && Contains("at"));
  CHECK_THAT(refusal(arm + "parts: {a: {part: arm, at: hbu}}\n"), Contains("parts.a.at") && Contains("hub"));
  CHECK_THAT(refusal(arm + "parts: {a: {part: arm}, a.root: {part: arm}}\nelements: {a.body: {}}\n"),
             Contains("elements.a.body") && Contains("two entries"));
  CHECK_THAT(refusal("definitions:\n  a: {parts: {b: {part: a}}}\nparts: {c: {part: a}}\n"), Contains("20 times"));
  CHECK_THAT(refusal("definitions: {a: {nods: {}}}\nparts: {c: {part: a}}\n"),
             Contains("definitions.a") && Contains("'nods'") && Contains("nodes"));
}

TEST_CASE("a point of a body takes the place of a node") {
  const std::string text = expanded(R"yaml(
nodes: {seat: {}}
elements:
  car: {type: rigid_body, node: seat, mass: 1, inertia: [1, 1, 1]}
  spring: {type: spring_damper, nodes: [{body: car, at: [0.1, 0, 0]}, ground], stiffness: 1}
)yaml");
  CHECK_THAT(text, Contains("spring.point_1: {at: seat, position: [0.1, 0, 0]}"));
  CHECK_THAT(text, Contains("also: [spring.point_1]") && Contains("nodes: [spring.point_1, ground]"));
  CHECK_THAT(refusal("elements:\n  s: {type: spring_damper, nodes: [{body: car}, ground]}\n"),
             Contains("model.yaml:2: elements.s.nodes[1]") && Contains("no element 'car'"));
  CHECK_THAT(refusal("nodes: {a: {}}\nelements:\n  m: {type: point_mass, node: a, mass: 1}\n"
                     "  s: {type: spring_damper, nodes: [{body: m}, ground]}\n"),
             Contains("no rigid_body"));
}

TEST_CASE("a node is carried by a rigid body, also by one outside of its part") {
  const std::string text = R"yaml(
nodes: {hub: {}}
elements: {hub: {type: rigid_body, node: hub, mass: 1, inertia: [1, 1, 1]}}
definitions:
  blade:
    nodes:
      root: {position: [1, 0, 0], carried_by: hub}
      mid: {}
      pin: {at: mid, position: [0, 2, 0], carried_by: spar}
    elements: {spar: {type: rigid_body, node: mid, mass: 2, inertia: [1, 1, 1], also: [own]}}
parts: {a: {part: blade}, b: {part: blade, rotation_vector: [0, 0, "pi/2"]}}
)yaml";
  const std::string written = expanded(text);
  CHECK_THAT(written,
             Contains("hub: {type: rigid_body, node: hub, mass: 1, inertia: [1, 1, 1], also: [a.root, b.root]}"));
  CHECK_THAT(written, Contains("also: [b.own, b.pin]") || Contains("also: [own, b.pin]"));
  CHECK_THAT(written, !Contains("carried_by"));
  CHECK_THAT(refusal("nodes:\n  a: {carried_by: wheel}\nelements: {whel: {}}\n"),
             Contains("model.yaml:2: nodes.a.carried_by") && Contains("'wheel'") && Contains("whel"));
  CHECK_THAT(refusal("nodes:\n  a: {carried_by: m}\n  b: {}\nelements: {m: {type: point_mass, node: b, mass: 1}}\n"),
             Contains("nodes.a.carried_by") && Contains("no rigid_body"));
  CHECK_THAT(refusal("nodes:\n  a: {carried_by: [m]}\n"), Contains("nodes.a.carried_by") && Contains("name"));
}

TEST_CASE("a part is placed in the axes of a node that is placed in those of many others") {
  const std::string link = "definitions: {link: {nodes: {tip: {position: [1, 0, 0]}}}}\n";
  const std::string chain = expanded(link + R"yaml(
nodes:
  "n_{k}": {repeat: {count: 50000, as: k}, at: "n_{k+1}", position: [1, 0, 0]}
  n_50001: {}
parts: {first: {part: link, at: n_1}, middle: {part: link, at: n_40001}}
)yaml");
  CHECK_THAT(chain,
             Contains("first.tip: {position: [50001, 0, 0]}") && Contains("middle.tip: {position: [10001, 0, 0]}"));
  CHECK_THAT(refusal(link + "nodes:\n  a: {at: b}\n  b: {at: a}\nparts: {p: {part: link, at: a}}\n"),
             Contains("model.yaml:4: parts.p.at: nodes are placed relative to each other in a circle, by way of 'a'"));
}

TEST_CASE("nodes that are merged may be repeated, placed at others of the part, and carried") {
  const auto placed = [](const std::string& nodes, const std::string& merge) {
    return "nodes: {hub: {}}\ndefinitions:\n  a:\n    nodes: {o: {position: [1, 0, 0]}, " + nodes +
           "}\n    elements: {b: {type: rigid_body, node: o, mass: 1, inertia: [1, 1, 1]}}\n"
           "parts: {p: {part: a, merge: {" +
           merge + "}}}\n";
  };
  CHECK_THAT(expanded(placed("\"n_{k}\": {repeat: {count: 2, as: k}, position: [k-1, 0, 0]}", "n_1: hub")),
             Contains("p.n_2:") && !Contains("p.n_1"));
  CHECK_THAT(expanded(placed("n: {at: o, position: [-1, 0, 0]}", "n: hub")), !Contains("p.n:"));
  CHECK_THAT(expanded(placed("n: {carried_by: b}", "n: hub")), Contains("also: [hub]"));
  CHECK_THAT(expanded(placed("n: {fixed: false}", "n: hub")), !Contains("p.n:"));
  CHECK_THAT(refusal(placed("n: {fixed: true}", "n: hub")),
             Contains("model.yaml:4: nodes.p.n.fixed") && Contains("`fixed` belongs to that one"));
  CHECK_THAT(refusal(placed("n: {velocity: [1, 0, 0]}", "n: hub")), Contains("nodes.p.n.velocity"));
  CHECK_THAT(refusal(placed("n: {if: 0}", "n: hub")), Contains("parts.p.merge") && Contains("no node 'n'"));
  CHECK_THAT(refusal(placed("n: {}", "n: [hub]")), Contains("model.yaml:6: parts.p.merge.n: expected a text"));
  CHECK_THAT(refusal(placed("n: {}", "n: {body: hub}")), Contains("parts.p.merge.n: expected the name of a node"));
}

TEST_CASE("definitions that are not placed are refused as well if they are wrong") {
  CHECK_THAT(refusal("nodes: {a: {}}\ndefinitions: {a: {nods: {}}}\n"),
             Contains("model.yaml:2: definitions.a: 'nods'") && Contains("nodes"));
  CHECK_THAT(refusal("definitions: [a]\n"), Contains("model.yaml:1: definitions: expected keys"));
  CHECK_THAT(refusal("definitions: {a: {gravity: [0, 0, 1]}}\n"), Contains("definitions.a: 'gravity'"));
  CHECK_THAT(refusal("definitions: {a: {definitions: {}}}\n"), Contains("definitions.a: 'definitions'"));
  CHECK_THAT(refusal("definitions: {a: {parameters: [1]}}\nparts: {p: {part: a}}\n"),
             Contains("model.yaml:1: parts.p.parameters: expected keys"));
  CHECK_THAT(refusal("definitions: {a: {hydraulics: 3}}\nparts: {p: {part: a}}\n"),
             Contains("hydraulics: expected keys"));
  CHECK_THAT(refusal(arm + "parts: {p: {part: [arm]}}\n"), Contains("parts.p.part: expected a text"));
  for (const std::string name : {"t", "sin", "pi", "1a", "a.b", "a b"})
    CHECK_THAT(refusal("definitions: {a: {parameters: {" + name + ": 1}}}\nparts: {p: {part: a}}\n"),
               Contains("parts.p.parameters: '" + name + "'"));
}

TEST_CASE("a file without sections is no part") {
  const bielle::test::TemporaryFolder folder;
  folder.file("text.yaml", "hello\n");
  folder.file("parts.yaml", "definitions: {a: {nodes: {n: {}}}}\n");
  const auto message = [&](const std::string& file) {
    return bielle::test::message_of<bielle::InputError>(
        [&] { expanded("parts: {p: {file: " + file + "}}\n", "", folder / "model.yaml"); });
  };
  CHECK_THAT(message("text.yaml"), Contains("text.yaml:1: expected sections"));
  CHECK_THAT(message("parts.yaml"), Contains("model.yaml:1: parts.p.file") && Contains("name the `part`"));
}

TEST_CASE("a name with dots within a part is one name in its formulas") {
  CHECK_THAT(expanded("definitions: {a: {nodes: {x.y: {}}, measures: {z: x.y.position.x + x.y.velocity.x}}}\n"
                      "parts: {p: {part: a}}\n"),
             Contains("p.z: p.x.y.position.x + p.x.y.velocity.x"));
}

TEST_CASE("values with units, and points of bodies, stand in parts that are turned or mirrored") {
  const auto placed = [](const std::string& sections, const std::string& keys = "rotation_vector: [0, 0, 1]") {
    return "definitions:\n  a:\n    nodes: {n: {}, m: {position: [\"1 m\", 0, 0]}}\n" + sections +
           "parts: {p: {part: a, " + keys + "}}\n";
  };
  const std::string load = "    loads: {f: {node: n, force: [";
  CHECK_THAT(expanded(placed(load + "\"1 kN\", t, 0]}}\n", "mirror: x")), Contains("force: [(-1)*(1000), (1)*(t)"));
  CHECK_THAT(refusal(placed(load + "\"1 kg\", 0, 0]}}\n")),
             Contains("model.yaml:4: loads.p.f.force[1]: '1 kg'") && Contains("expected a value in N"));
  CHECK_THAT(refusal(placed(load + "\"'a\", 0, 0]}}\n")), Contains("model.yaml:4: loads.p.f.force[1]: ''a'"));
  const std::string body =
      "    elements: {b: {type: rigid_body, node: n, mass: 1, inertia: [1, 1, 1, \"1 kg m^2\", 0, 0]}}\n";
  CHECK_THAT(expanded(placed(body, "mirror: x")), Contains("inertia: [1, 1, 1, -(1), -(0), 0]"));
  CHECK_THAT(expanded(placed(body + "    joints: {h: {type: hinge, nodes: [{body: b, at: [0.5, 0, 0]}, m], "
                                    "axis: [[0, 0, 1], [0, 0, 1]]}}\n")),
             Contains("nodes: [p.h.point_1, p.m]") && Contains("second_axis"));
  CHECK_THAT(refusal(placed(body + "    loads: {f: {node: {body: b, att: [1, 0, 0]}, force: [0, 0, 1]}}\n")),
             Contains("loads.p.f.node: 'att' is not a key of a point of a body"));
}
