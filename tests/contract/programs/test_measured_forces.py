"""Tests of forces, stresses, pressures and clearances in formulas: a torque, a spring and an event read each of them,
and must have the recorded values."""

import os
import subprocess
import sys
import unittest

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

from in_folder import InFolder  # noqa: E402

PROGRAM = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-mechanism")
# A rotor and a slider are next to the machine; their torque and spring read its measure.
READERS = """
  rotor: {{position: [0, 9, 0]}}
  slider: {{position: [1, 9, 0]}}
elements:
  rotor: {{type: rigid_body, node: rotor, mass: 1, inertia: [1, 1, 1]}}
  slider: {{type: rigid_body, node: slider, mass: 1, inertia: [1, 1, 1]}}
  reader: {{type: spring_damper, nodes: [rotor, slider], force: "{factor}*{measure}"}}
{elements}
joints:
  axle: {{type: hinge, nodes: [ground, rotor], position: [0, 9, 0], axis: [0, 0, 1]}}
  rail: {{type: prismatic, nodes: [ground, slider], position: [1, 9, 0], axis: [0, 1, 0]}}
{joints}
drives:
  motor: {{joint: axle, torque: "{factor}*{measure}"}}
{drives}
measures: {{it: "{measure}"}}
events: {{reached: {{when: "{measure}", crosses: {level}}}}}
"""


def model(head, elements, joints, drives, measure, level, factor, tail):
    return head + READERS.format(elements=elements, joints=joints, drives=drives, measure=measure, level=level, factor=factor) + tail


def beam(measure, level):
    section = "{rectangle: [0.03, 0.04], young: 2e11, poisson: 0.3, density: 7800, stress_points: [[0, 0.02], [0.015, 0]]}"
    return model("nodes:\n  root: {fixed: true}\n  tip: {position: [1, 0, 0]}", f"  boom: {{type: beam, nodes: [root, tip], elements: 2, damping: 1e-3, section: {section}}}", "", "",
                 measure, level, 1e-6 if "s" in measure.split(".", 2)[2] else 1e-3, 'loads: {end: {node: tip, force: ["100*t", 0, "200*t"]}}\n')


def spring(measure, level):
    return model("gravity: [0, 0, -9.81]\nnodes:\n  bob: {position: [0, 0, -1]}", "  bob: {type: point_mass, node: bob, mass: 1}\n  strut: {type: spring_damper, nodes: [ground, bob], stiffness: 100, length: 1}",
                 "", "", measure, level, 0.1, "")


def gears(measure, level):
    wheels = "\n".join(f"  {name}: {{type: rigid_body, node: {name}, mass: 1, inertia: [0.01, 0.01, 0.01]}}" for name in ("pinion", "wheel"))
    joints = """  drive: {type: hinge, nodes: [ground, pinion], axis: [0, 0, 1]}
  output: {type: hinge, nodes: [ground, wheel], position: [0.105, 0, 0], axis: [0, 0, 1]}
  teeth: {type: gear_mesh, nodes: [pinion, wheel], axes: [0, 0, 1], radii: [0.03, 0.075], stiffness: 1e6, damping: 0.001}"""
    return model("nodes:\n  pinion: {position: [0, 0, 0]}\n  wheel: {position: [0.105, 0, 0]}", wheels, joints, "", measure, level, 1e-3,
                 'loads: {torque: {node: pinion, moment: [0, 0, "20*t"]}}\n')


def jack(measure, level):
    return model("gravity: [0, 0, -9.81]\nnodes:\n  weight: {position: [0, 0, 1]}", """  weight: {type: rigid_body, node: weight, mass: 1000, inertia: [10, 10, 10]}
  jack: {type: hydraulic_actuator, nodes: [ground, weight], stroke: [0.8, 1.3], piston_areas: [5e-3, 3e-3], dead_volumes: [1e-4, 1e-4], supply: {pressure: 2e7, tank: 101325}, valve: {area: 1e-5, command: "step(t, 0, 0.1)"}}""",
                 "  guide: {type: prismatic, nodes: [ground, weight], position: [0, 0, 1], axis: [0, 0, 1]}", "", measure, level, 1e-6, "")


def play(measure, level):
    return model("gravity: [0, 0, -9.81]\nnodes:\n  pin: {position: [0, 0, 0]}", "  pin: {type: rigid_body, node: pin, mass: 0.2, inertia: [1e-4, 1e-4, 1e-4]}",
                 "  bore: {type: clearance_hinge, nodes: [ground, pin], axis: [0, 1, 0], radial_gap: 1e-4, axial_gap: 2e-4, radius: 0.008, contact: {stiffness: 1e6, restitution: 0.3}}", "",
                 measure, level, 1000 if "gap" in measure else 0.1, "")


MODELS = {  # text of the model, its duration, and the recorded dataset of the measure with its column
    "section force": (beam("boom.element_2.force.x", 5), 0.2, "elements/boom/resultants", (1, 0)),
    "section moment": (beam("boom.element_1.moment.y", -5), 0.2, "elements/boom/resultants", (0, 4)),
    "stress": (beam("boom.element_1.stress.p1.xx", -2e5), 0.2, "elements/boom/stress", (0, 0, 0)),
    "von Mises stress": (beam("boom.element_2.von_mises.p2", 1e4), 0.2, "elements/boom/von_mises", (1, 1)),
    "largest stress": (beam("boom.von_mises.max", 2e5), 0.2, "elements/boom/von_mises", max),
    "spring force": (spring("strut.force", 3), 0.2, "elements/strut/force", ()),
    "tooth force": (gears("teeth.force", 5), 0.1, None, None),
    "pressure": (jack("jack.pressure_1", 3e6), 0.2, "elements/jack/pressure", (0,)),
    "clearance": (play("bore.gap", 5e-5), 0.02, None, None),
    "force of a clearance": (play("bore.normal_force", 1), 0.02, None, None),
}


class MeasuredForces(InFolder):
    def test_each_is_read_by_a_torque_a_spring_and_an_event(self):
        for name, (text, duration, place, column) in MODELS.items():
            with self.subTest(name):
                self.write("m.yaml", text + f"analysis:\n  - {{type: dynamic, duration: {duration}, step: 1e-4}}\n")
                done = subprocess.run([PROGRAM, "m.yaml", "-o", "m.h5"], cwd=self.folder, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.compare(text, place, column)

    def compare(self, text, place, column):
        factor = float(text.partition("torque: \"")[2].partition("*")[0])
        with h5py.File(self.path("m.h5")) as file:
            it, times = file["measures/it"][()].reshape(-1), file["time"][()]
            torque, force = file["joints/axle/drive_force"][()].reshape(-1), file["elements/reader/force"][()].reshape(-1)
            recorded = None if place is None else file[place][()].reshape(len(times), *file[place].shape[1:])
            crossings = file["crossings"].asstr()[()].splitlines()
            when = [time for time, number in zip(file["events/time"], file["events/crossing"]) if "'reached'" in crossings[int(number)]]
        size = np.abs(it).max()
        self.assertGreater(size, 0)
        np.testing.assert_allclose(torque, factor * it, rtol=0, atol=1e-9 * factor * size)
        np.testing.assert_allclose(force, factor * it, rtol=0, atol=1e-9 * factor * size)
        if place is not None:
            values = recorded.reshape(len(times), -1).max(axis=1) if column is max else recorded[(slice(None), *column)].reshape(-1)
            np.testing.assert_allclose(it, values, rtol=0, atol=1e-9 * size)
        level = float(text.partition("crosses: ")[2].partition("}")[0])
        first = np.flatnonzero(np.diff(np.sign(it - level)))[0]
        self.assertTrue(times[first] <= when[0] <= times[first + 1], (when, times[first]))


if __name__ == "__main__":
    unittest.main()
