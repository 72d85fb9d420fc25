"""Fuzz of mechanism files with includes, parts, repetitions and conditions: words are exchanged, removed or doubled."""

import os
import subprocess
import unittest

from fuzzing import PROGRAMS, FuzzTest
from test_fuzz_yaml import ODD, mutated

MODEL = """\
include: [common.yaml, more.yaml]
gravity: [0, 0, -9.81]
parameters: {arms: 3, half: 0, speed: 60 rpm, mass: 2}
definitions:
  arm:
    parameters: {length: 0.5, heavy: 1}
    nodes:
      root: {position: [0.1, 0, 0]}
      pad: {position: [0.1, 0, 0], carried_by: hub}
      tip: {at: root, position: [length, 0, 0], carried_by: bar}
      "pin_{k}": {repeat: {count: 2, as: k}, position: ["0.1 + k*length/3", 0, 0], carried_by: bar}
    elements:
      bar: {type: rigid_body, node: root, mass: mass, centre: [length/2, 0, 0], inertia: [0.01, 0.1, 0.1]}
      weight: {if: heavy, type: point_mass, node: tip, mass: 1}
      spring: {type: spring_damper, nodes: [pad, {body: bar, at: [length/2, 0, 0.1]}], stiffness: 100, damping: 1}
    joints:
      knee: {type: hinge, nodes: [pad, root], axis: [0, 1, 0], locked: half, stiffness: 50}
    measures:
      height: "tip.position.z - length"
    parts:
      tool: {part: tool, at: tip, rotation_vector: [0, 0.3, 0], if: heavy}
  tool:
    nodes: {body: {position: [0.05, 0, 0]}}
    elements: {body: {type: rigid_body, node: body, mass: 0.1, inertia: [1e-3, 1e-3, 1e-3]}}
    joints: {flange: {type: hinge, nodes: [tip, body], axis: [1, 0, 0], stiffness: 3, damping: 0.1}}
    loads: {push: {node: body, force: [0, 1, 0]}}
nodes: {hub: {}}
elements: {hub: {type: rigid_body, node: hub, mass: 5, inertia: [1, 1, 1]}}
joints: {shaft: {type: hinge, nodes: [ground, hub], axis: [0, 0, 1], start_rate: speed}}
parts:
  "arm_{k}": {repeat: {count: arms, as: k}, part: arm, at: hub, rotation_vector: [0, 0, "2*pi*k/arms"], parameters: {length: "0.3 + 0.1*k"}}
  "{side}": {repeat: {over: [left, right], as: side}, part: arm, position: [0, 0, 0.2], mirror: y, parameters: {heavy: 0}}
  far: {file: arm.yaml, position: [3, 0, 0], merge: {foot: far}}
measures: {lowest: "min(arm_1.height, arm_2.height)"}
cases:
  slow: {parameters: {speed: 6 rpm}, analysis: [{type: dynamic, duration: 0.002, step: 0.001}]}
  still: {parameters: {half: 1}}
analysis: [{type: dynamic, duration: 0.002, step: 0.001}]
"""
COMMON = """\
include: more.yaml
parameters: {mass: 1}
nodes: {cart: {position: [0, 2, 0]}}
elements: {cart: {type: rigid_body, node: cart, mass: mass, inertia: [1, 1, 1]}}
joints: {rail: {type: prismatic, nodes: [ground, cart], axis: [1, 0, 0]}}
"""
MORE = "nodes:\n  far: {position: [3, 0, 0], fixed: true}\n  near: {fixed: true}\n"
ARM = """\
parameters: {size: 0.4}
nodes: {foot: {}, hand: {position: [size, 0, 0]}}
elements: {hand: {type: rigid_body, node: hand, mass: 1, inertia: [1, 1, 1]}}
joints: {wrist: {type: hinge, nodes: [foot, hand], axis: [0, 1, 0]}}
analysis: [{type: static}]
"""
FILES = {"model.yaml": MODEL, "common.yaml": COMMON, "more.yaml": MORE, "arm.yaml": ARM}
# Words with a meaning in these files.
WORDS = ["model.yaml", "common.yaml", "arm.yaml", ".", "/", "/dev/null", "none.yaml", "hub", "tip", "arm", "tool", "far", "arm_1",
         "arm_1.tip", "far.hand", '"{k}"', '"{"', '"}"', '"{k+1}"', '"{2.5}"', '"{zz}"', "{part: arm}", "{count: 2, as: k}", "k",
         "{over: [a, b], as: k}", "{count: 100000, as: k}", "{count: -1, as: k}", "3 m", "1 rpm", "{body: hub, at: [0, 0, 0]}",
         "x", "mirror", "repeat", "parts", "[hub]", "true", "slow"]


class Language(FuzzTest):
    def run_model(self, note, *arguments):
        return self.judge(note, list(FILES), "bielle-mechanism", "model.yaml", "--quiet", *arguments)

    def write_all(self, changes):
        for name, text in {**FILES, **changes}.items():
            self.write(name, text)

    def expanded(self):
        return subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "model.yaml", "--expand"], cwd=self.folder,
                              capture_output=True, text=True, timeout=120)

    def test_the_sound_files_run(self):
        self.write_all({})
        for arguments in ([], ["--case", "slow"], ["--case", "still"]):
            self.assertEqual(self.run_model("sound", *arguments), 0)

    def test_damaged_files(self):
        for case, rng in self.cases(80):
            name = rng.choice(["model.yaml"] * 5 + list(FILES))
            text, note = mutated(rng, FILES[name], rng.choice([ODD, WORDS, WORDS]))
            self.write_all({name: text})
            self.run_model(f"{case} {name} {note}", *rng.choice([[], [], ["--case", "slow"], ["--check"]]))

    def test_what_is_expanded_is_what_runs(self):
        """If a damaged model is accepted, its expanded text is accepted as well, and contains nothing to expand."""
        for case, rng in self.cases(20):
            text, note = mutated(rng, MODEL, WORDS)
            self.write_all({"model.yaml": text})
            if self.run_model(f"{case} {note}", "--check") == 0:
                expanded = self.expanded()
                self.assertEqual(expanded.returncode, 0, note)
                self.write("model.yaml", expanded.stdout)
                self.assertEqual(self.run_model(f"{case} {note}: expanded", "--check"), 0, note)
                self.assertEqual(self.expanded().stdout, expanded.stdout, note)


if __name__ == "__main__":
    unittest.main()
