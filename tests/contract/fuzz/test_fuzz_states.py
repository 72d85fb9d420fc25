"""Fuzz of checkpoints without checksums, whose states have other numbers: a run checks each number of the state that it
continues."""

import shutil
import unittest

import h5py
import numpy as np

from fuzzing import FuzzTest

MODEL = """\
gravity: [0, 0, -9.81]
nodes:
  upper: {position: [0.5, 0, 0]}
  lower: {position: [1.5, 0, 0]}
  slide: {position: [5, 0, 0], velocity: [1, 0, 0], fixed: [y, z, rx, ry, rz]}
  ball: {position: [3, 0, 0.105], velocity: [0.5, 0, -0.5]}
  tip: {position: [7, 0, 0]}
  root: {position: [6, 0, 0], fixed: true}
elements:
  upper: {type: rigid_body, node: upper, mass: 1, inertia: [0.01, 0.1, 0.1]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.01, 0.1, 0.1]}
  slide: {type: point_mass, node: slide, mass: 1}
  spring: {type: spring_damper, nodes: [ground, slide], stiffness: 500, length: 5}
  ball: {type: rigid_body, node: ball, solid: {sphere: 0.1, density: 1000}}
  beam: {type: beam, nodes: [root, tip], elements: 2, section: {circle: 0.01, young: 2e11, poisson: 0.3, density: 7800}}
joints:
  shoulder: {type: hinge, nodes: [ground, upper], axis: [0, 1, 0], position: [0, 0, 0], friction: {coefficient: 0.3, radius: 0.02, model: stick_slip}}
  elbow: {type: hinge, nodes: [upper, lower], axis: [0, 1, 0], position: [1, 0, 0], stops: {range: [-1, 1], stiffness: 1e4, damping: 10}}
  floor: {type: contact, shapes: [{node: ground, plane: [0, 0, 1]}, {node: ball, sphere: 0.1}], stiffness: 1e6, restitution: 0.7,
          friction: {coefficient: 0.3, model: lugre, bristle_stiffness: 1e3, bristle_damping: 1}}
states: {lag: {rate: "-lag + slide.position.x"}, slow: {filter: shoulder.angle, frequency: 5}}
drives: {servo: {joint: elbow, pid: {target: "0.3*sin(5*t)", kp: 30, ki: 10, kd: 1, limit: 20}}}
events: {far: {when: slide.position.x, crosses: 5.01}}
analysis: [{type: dynamic, duration: DURATION, step: 0.001}]
output: {every: 2, checkpoint: 4, log: true}
"""
NUMBERS = [np.nan, np.inf, -np.inf, 1e300, -1e300, -1.0, 0.0, 0.5, 1.0, 2.0, 7.0, 2.0**31, 2.0**53, 1e18, -1e-300]


class States(FuzzTest):
    def test_numbers_of_checkpoints(self):
        self.write("model.yaml", MODEL.replace("DURATION", "0.02"))
        self.assertEqual(self.judge("sound", [], "bielle-mechanism", "model.yaml", "-o", "good.h5", "--quiet"), 0)
        with h5py.File(self.path("good.h5"), "r+") as file:
            for name in ("checksum", "rows_checksum"):
                del file[f"checkpoints/analysis_1/{name}"]
        self.write("model.yaml", MODEL.replace("DURATION", "0.025"))
        refused = 0
        for case, rng in self.cases(80):
            shutil.copy(self.path("good.h5"), self.path("bad.h5"))
            with h5py.File(self.path("bad.h5"), "r+") as file:
                states = file["checkpoints/analysis_1/state"]
                state = states[-1]
                note = str(case)
                for _ in range(rng.choice([1, 1, 1, 3, 20])):
                    place = rng.randrange(len(state))
                    state[place] = rng.choice([*NUMBERS, state[place] + 1, -state[place], state[rng.randrange(len(state))]])
                    note += f" [{place}]={state[place]}"
                states[-1] = state
            refused += self.judge(note, ["bad.h5"], "bielle-mechanism", "model.yaml", "--restart", "bad.h5", "-o", "out.h5", "--quiet") == 1
        self.assertGreater(refused, (case + 1) / 4)


if __name__ == "__main__":
    unittest.main()
