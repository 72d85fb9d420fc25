"""Texts of models for several tests, and a base class of tests that write such files."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from in_folder import InFolder  # noqa: E402

# A double pendulum of bars, which falls through large angles, with a formula of the state.
PENDULUM = """\
mechanism: a double pendulum
gravity: [0, 0, -9.81]
parameters: {mass: 2, length: 1}
nodes:
  upper: {position: ["length/2", 0, 0]}
  lower: {position: ["1.5*length", 0, 0]}
elements:
  upper: {type: rigid_body, node: upper, mass: "mass", inertia: [0.01, 0.17, 0.17]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.01, 0.08, 0.08]}
joints:
  shoulder: {type: hinge, nodes: [ground, upper], position: [0, 0, 0], axis: [0, 1, 0], damping: 0.05}
  elbow: {type: hinge, nodes: [upper, lower], position: ["length", 0, 0], axis: [0, 1, 0]}
measures:
  reach: {formula: "distance(ground, lower)", units: m}
analysis:
  - {type: dynamic, duration: 1.2, step: 2e-3}
"""

# A cantilever that its load bends and then releases.
BEAM = """\
mechanism: a cantilever
nodes:
  root: {fixed: true}
  tip: {position: [1, 0, 0]}
elements:
  beam: {type: beam, nodes: [root, tip], elements: 6, section: {rectangle: [0.01, 0.02], young: 7e10, poisson: 0.3, density: 2700}}
loads:
  push: {node: tip, force: [0, 0, "200*(t < 0.02)"]}
analysis:
  - {type: static, steps: 4}
  - {type: dynamic, duration: 0.1, step: 1e-3}
"""

# A wheel on an axle, driven by a torque.
WHEEL = """\
nodes: {wheel: {}}
elements: {wheel: {type: rigid_body, node: wheel, mass: 1, inertia: [1, 1, 2]}}
joints: {axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}}
inputs: {torque: {start: 0, units: N m}}
drives: {motor: {joint: axle, torque: torque}}
"""


class WithModel(InFolder):
    def write_model(self, text, name="model.yaml"):
        """@returns the path"""
        return self.write(name, text)
