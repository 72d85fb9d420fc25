"""Fuzz of mechanism and body files: words and numbers are exchanged, removed or doubled."""

import re
import unittest

from fuzzing import FuzzTest, damaged_bytes
from test_reduce import BAR

MECHANISM = """\
mechanism: everything
gravity: [0, 0, -9.81]
parameters: {w: 10.0, r: 0.1}
nodes:
  crank: {position: [0, 0, 0], angular_velocity: [0, 10, 0]}
  pin: {position: ["r", 0, 0], rotation_vector: [0, 0, 0]}
  arm: {position: ["r", 0, 0], velocity: [0, 0, -1]}
  tip: {position: [0.3, 0, 0], quaternion: [1, 0, 0, 0]}
  base: {position: [0, 0.5, 0], motion: {x: "0.01*sin(w*t)"}, fixed: [y, z, rx, ry, rz]}
  bob: {position: [0, 0.5, -0.2], bryant: [0, 0, 0], fixed: [rx, ry, rz]}
  slider: {position: [1, 1, 0], axes: {x: [1, 0, 0], y: [0, 1, 0]}}
  shaker: {position: [2, 0, 0], fixed: [y, z, rx, ry, rz], motion: {x: {acceleration: "sin(w*t)", velocity: 0.1, displacement: 0}}}
  shaken: {position: [2, 0, 0.1]}
  rotor: {position: [3, 0, 0], angular_velocity: [0, 0, 9]}
  ball: {position: [3, 0, 0.0011], velocity: [0, 0, 0.1]}
elements:
  shaken: {type: rigid_body, node: shaken, mass: 1, inertia: [0.01, 0.01, 0.01]}
  rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.01, 0.01, 0.01]}
  ball: {type: rigid_body, node: ball, mass: 1, inertia: [0.01, 0.01, 0.01]}
  body: {type: rigid_body, node: crank, also: [pin], mass: 1, inertia: [0.01, 0.01, 0.01]}
  link: {type: beam, nodes: [arm, tip], elements: 2, orientation: [0, 1, 0], damping: 1e-4, section: {i: {width: 0.02, height: 0.04, web: 0.002, flange: [0.003, 0.004]}, young: 2e11, poisson: 0.3, density: 7800}}
  weight: {type: point_mass, node: bob, mass: 2}
  spring: {type: spring_damper, nodes: [base, bob], stiffness: 1000, damping: 1, length: 0.2}
  block: {type: rigid_body, node: slider, solid: [{box: [0.1, 0.1, 0.1], density: 1000}]}
joints:
  main: {type: hinge, nodes: [ground, crank], axis: [0, 1, 0], position: [0, 0, 0]}
  pinj: {type: hinge, nodes: [pin, arm], axis: [0, 1, 0]}
  slide: {type: cylindrical, nodes: [ground, slider], axis: [0, 0, 1]}
  mount: {type: bushing, nodes: [shaker, shaken], stiffness: [1e4, 1e4, 2e4, 100, 100, 50], damping: 1e-3, preload: [0, 0, -9.81, 0, 0, 0], curves: {x: "1e5*q^3"}, maxwell: [{factor: 0.5, time: 0.01}]}
  bearing: {type: bearing, nodes: [ground, rotor], axis: [0, 0, 1], radial: {stiffness: [1e5, 2e5], damping: 10}, axial: 1e5, tilting: 100}
  play: {type: clearance_hinge, nodes: [rotor, ball], at: [[0, 0, 0], [0, 0, 0]], axis: [0, 0, 1], radial_gap: 0.001, axial_gap: 0.001, length: 0.02, radius: 0.01, contact: {stiffness: 1e8, restitution: 0.5}, friction: {coefficient: 0.1, velocity: 0.01}}
drives:
  motor: {joint: main, rate: "w*step(t, -1, 0)"}
  lift: {joint: slide, coordinate: displacement, force: "10*t"}
loads:
  push: {node: tip, force: [0, 0, "-1*t"], moment: [0, 0, 0], follower: false}
analysis:
  - {type: dynamic, duration: 0.004, step: 0.001, rho: 0.8, newton: {tolerance: 1e-9, iterations: 20}}
output: {every: 2, checkpoint: 2}
"""

BODY = """\
body: bar
parameters: {E: 210e9}
geometry: bar.geo
mesh: {size: 0.04, order: 1}
materials:
  steel: {young: "E", poisson: 0.3, density: 7850}
regions: {bar: steel}
interfaces:
  left: {surface: left, tie: rigid, position: [0, 0.01, 0.01], directions: [x, y, z, rx, ry, rz]}
  right: {surface: {plane: {point: [0.2, 0, 0], normal: [1, 0, 0]}}, tie: average, rotation_vector: [0, 0, 0]}
modes: {count: 3}
damping: {ratio: 0.01}
loads:
  snow: {surface: bottom, pressure: 1e5}
recovery: {displacement: all, stress: surface}
"""

# These numbers do not make a valid model slow, since such models are not refused.
ODD = ["-1", "0", ".nan", "-.inf", "1e300", "-1e300", "1e-300", "1e999", "", '""', "banana", "[1, 2]", "[]", "{a: 1}", "{}",
       "true", "~", '"1/0"', '"sqrt(-1)"', '"2*zz"', '"5 mm"', "2.5", '"t"', "ground", '"/"', '"."', '"a\\0b"', "&a", "*a",
       "!!binary x", '"' + "(" * 300 + '"', "\t", "'", ",", ":", "[", "}", "\n", "#", "<<", "x" * 300,
       "\"table('/dev/zero', t)\"", "99999999999"]


def mutated(rng, text, odd=None):
    """Makes one to three changes of words, outside of the line with the mesh size. @param odd  words to insert"""
    note = []
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        lines = text.split("\n")
        if not text.strip():
            break
        number = rng.choice([k for k, line in enumerate(lines) if line.strip() and not line.startswith("mesh:")])
        words = re.findall(r'"[^"]*"|[\w.+-]+|\s+|.', lines[number])
        place = rng.choice([k for k, word in enumerate(words) if word.strip()])
        kind = rng.choice(["odd", "odd", "odd", "leave out", "double", "exchange", "line out", "line twice"])
        note.append(f"{kind} line {number + 1} word {words[place][:20]!r}")
        if kind == "odd":
            words[place] = rng.choice(odd or ODD)
            note[-1] += f" := {words[place][:20]!r}"
        elif kind == "leave out":
            del words[place]
        elif kind == "double":
            words.insert(place, words[place] + " ")
        elif kind == "exchange":
            other = rng.randrange(len(words))
            words[place], words[other] = words[other], words[place]
        lines[number] = "".join(words)
        if kind == "line out":
            del lines[number]
        elif kind == "line twice":
            lines.insert(number, lines[number])
        text = "\n".join(lines)
    return text, "; ".join(note)


class Yaml(FuzzTest):
    def test_the_sound_files_run(self):
        self.write("model.yaml", MECHANISM)
        self.assertEqual(self.judge("sound", [], "bielle-mechanism", "model.yaml", "--quiet"), 0)
        self.write("bar.geo", BAR)
        self.write("body.yaml", BODY)
        self.assertEqual(self.judge("sound", [], "bielle-reduce", "body.yaml", "--quiet"), 0)

    def test_mechanism_files(self):
        for case, rng in self.cases(50):
            text, note = mutated(rng, MECHANISM)
            self.write("model.yaml", text)
            self.judge(f"{case} {note}", ["model.yaml"], "bielle-mechanism", "model.yaml", "--quiet")

    def test_body_files(self):
        self.write("bar.geo", BAR)
        for case, rng in self.cases(25):
            text, note = mutated(rng, BODY)
            self.write("body.yaml", text)
            self.judge(f"{case} {note}", ["body.yaml"], "bielle-reduce", "body.yaml", "--quiet")

    def test_bytes(self):
        self.write("bar.geo", BAR)
        for case, rng in self.cases(15):
            text, note = damaged_bytes(rng, MECHANISM.encode())
            self.write("model.yaml", text)
            self.judge(f"{case} {note}", ["model.yaml"], "bielle-mechanism", "model.yaml", "--quiet")
            text, note = damaged_bytes(rng, BODY.replace("mesh: {size: 0.04, order: 1}\n", "").encode())
            self.write("body.yaml", text)
            self.judge(f"{case} {note}", ["body.yaml"], "bielle-reduce", "body.yaml", "--quiet")


if __name__ == "__main__":
    unittest.main()
