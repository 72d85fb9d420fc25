"""Tests mechanism/examples/winch.yaml: the lever winds whole teeth, and the ratchet holds them."""

import unittest

import numpy as np

from example import ExampleTest

PITCH = 2 * np.pi / 30
PERIOD = 2 * np.pi / 3  # time of a turn of the crank, whose speed rises during the first 0.2 s [s]
G, LOAD, RADIUS = 9.81, 100, 0.15


class Winch(ExampleTest):
    model = "winch.yaml"

    def test_teeth_and_lift_are_those_of_the_geometry(self):
        self.assert_gallery_checks("winch", {"run": self.path})

    def test_each_turn_ends_two_teeth_farther(self):
        drum = self.rows("joints/drum/coordinate")
        held = [drum[np.searchsorted(self.time, 0.1 + turn * PERIOD) - 1] for turn in range(6)]
        np.testing.assert_allclose(held, 2 * PITCH * np.arange(6), atol=1e-6)

    def test_pawl_and_clutch_take_turns(self):
        drum = [name for name, _ in self.events() if name.startswith("joint 'drum'")]
        clutch = [name for name, _ in self.events() if name.startswith("joint 'clutch'")]
        self.assertEqual(drum, [f"joint 'drum': one-way clutch on angle {word}" for word in 5 * ("opens", "holds")])
        self.assertEqual(clutch, [f"joint 'clutch': one-way clutch on angle {word}" for word in 5 * ("opens", "holds")])
        flags = {joint: self.rows(f"joints/{joint}/one_way_holds") for joint in ("drum", "clutch")}
        self.assertTrue(np.all(flags["drum"] + flags["clutch"] > 0), "one of them always holds the load")

    def test_the_pawl_carries_the_load_while_the_lever_goes_back(self):
        force = self.rows("joints/drum/one_way_force")
        still = (self.time > 2.0) & (self.time < 2.15)
        np.testing.assert_allclose(force[still], G * LOAD * RADIUS, rtol=1e-3)

    def test_energy_balance_closes(self):
        self.assertLess(np.abs(self.rows("energy/balance")).max(), 1e-3 * self.rows("energy/input")[-1])


if __name__ == "__main__":
    unittest.main()
