"""Compares every type of joint in mechanism/examples/joints.yaml with a closed form (elastic ones are in
flexible_joints.yaml and bearings.yaml)."""

import math
import os
import re
import unittest

import numpy as np

from example import EXAMPLES, REPOSITORY, ExampleTest

MODEL = os.path.join(EXAMPLES, "joints.yaml")


class Joints(ExampleTest):
    model = "joints.yaml"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.turned = 6 * cls.time ** 2

    def coordinate(self, joint, which=0):
        return np.array(self.results.rows(f"joints/{joint}/coordinate"))[:, which]

    def assert_follows(self, joint, expected, tolerance, which=0):
        np.testing.assert_allclose(self.coordinate(joint, which), expected, atol=tolerance, err_msg=joint)

    def test_every_type_of_joint_is_there(self):
        with open(os.path.join(REPOSITORY, "mechanism", "io", "component_table.cpp"), encoding="utf-8") as file:
            types = set(re.findall(r'\{Section::joints, "(\w+)"', file.read()))
        used = set()
        for model in (MODEL, *(os.path.join(os.path.dirname(MODEL), name) for name in ("flexible_joints.yaml", "bearings.yaml"))):
            with open(model, encoding="utf-8") as file:
                used |= set(re.findall(r"type: (\w+)", file.read()))
        # A rod with two balls is another name of `distance`; contacts.yaml has contacts, and the manual's page of tyres
        # has a model.
        self.assertEqual(types - used - {"spherical_spherical", "contact", "tyre"}, set())

    def test_shafts(self):
        bend = math.radians(25)
        # The input arm is drawn along x, in the plane of the shafts.
        expected = np.unwrap(np.arctan2(np.sin(self.turned), np.cos(self.turned) * math.cos(bend)))
        self.assert_follows("u_bearing_out", expected, 1e-7)
        self.assert_follows("c_bearing_out", self.turned, 1e-7)

    def test_screw_gears_and_racks(self):
        self.assert_follows("jack_guide", -0.01 * self.turned / (2 * math.pi), 1e-9)
        self.assert_follows("w2_bearing", -0.5 * self.turned, 1e-8)
        self.assert_follows("carrier_bearing", 0.2 * self.turned, 1e-8)
        self.assert_follows("planet_bearing", -0.2 * self.turned * 8 / 3, 1e-8)
        self.assert_follows("rack_guide", 0.05 * np.sin(3 * self.time), 1e-9)
        left, right = self.coordinate("left_bearing"), self.coordinate("right_bearing")
        np.testing.assert_allclose(left, 4 * right, atol=1e-8)  # a quarter of the inertia
        self.assert_follows("input_bearing", 1.5 * (left + right), 1e-8)

    def test_cams_belts_and_cables(self):
        self.assert_follows("tappet_guide", 0.01 * np.sin(self.turned), 1e-6)
        s = np.clip((np.mod(self.turned, 2 * math.pi) - 2) / (2 * math.pi / 3), 0, 1)
        self.assert_follows("valve_guide", 0.008 * np.sin(math.pi * s) ** 4, 1e-4)
        self.assert_follows("large_bearing", self.turned / 2, 0.01)
        height = np.array(self.results.rows("nodes/load/position"))[:, 2]
        np.testing.assert_allclose(height, -1 - 0.1 * 3 * self.time ** 2, atol=1e-3)

    def test_wheels_and_guides(self):
        disk = np.array(self.results.rows("nodes/disk/position"))
        np.testing.assert_allclose(disk, np.outer(np.ones_like(self.time), [16, 0, 0.3]) +
                                   np.outer(self.time, [0, 1.5, 0]), atol=1e-8)
        swing = np.array(self.results.rows("nodes/swing/position")) - [3, 0, 0]
        np.testing.assert_allclose(np.linalg.norm(swing, axis=1), 0.5 - 0.05 * self.time, atol=1e-9)
        ring = self.coordinate("ring_joint")
        self.assertLess(ring[-1], -0.01)  # the slider has moved down
        car = np.array(self.results.rows("nodes/car/position"))
        np.testing.assert_allclose(np.hypot((car[:, 0] - 7) / 0.5, car[:, 1] / 0.3), 1, atol=1e-4)


if __name__ == "__main__":
    unittest.main()
