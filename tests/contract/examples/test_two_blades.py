"""Compares Floquet exponents of mechanism/examples/two_blades.yaml, a rotor with two blades under gravity, with an
integration over one turn."""

import os
import subprocess
import unittest

from example import EXAMPLES, PROGRAM, ExampleTest
from bielle_tools.gallery.machines import two_blades


class TwoBlades(ExampleTest):
    model = "two_blades.yaml"

    def test_exponents_are_those_of_the_nonlinear_equations(self):
        self.assertEqual(len(two_blades.modes(self.path)), 3)
        self.assert_gallery_checks("two_blades", {"modes": self.path})

    def test_each_mode_is_another_exponent(self):
        _, found = two_blades.exponents(two_blades.RATE)
        nearest = [two_blades.nearest(value, found, two_blades.RATE) for value in two_blades.modes(self.path)]
        for k, one in enumerate(nearest):
            for other in nearest[:k]:
                self.assertGreater(abs(one.real - other.real), 1e-3)

    def test_a_resonance_that_is_locked_to_the_rotation_grows(self):
        # The exponents are real: the support moves at the rate of the rotation, with equal harmonics on both sides.
        target, rate = os.path.join(self.folder, "resonant.h5"), 12
        model = os.path.join(EXAMPLES, self.model)
        subprocess.run([PROGRAM, model, "--set", f"rate={rate}", "-o", target, "--quiet"], check=True, timeout=100)
        _, expected = two_blades.exponents(rate)
        found = two_blades.modes(target)
        self.assertEqual(len(found), 4)
        for value in found:
            self.assertLess(abs(two_blades.nearest(value, expected, rate).real - value.real), 1e-6)
        self.assertEqual(sum(value.real > 0 for value in found), 1)

    def test_gravity_matters(self):
        # Without gravity the motion is steady, and the decay rate of the second exponent differs.
        target = os.path.join(self.folder, "weightless.h5")
        model = os.path.join(self.folder, "weightless.yaml")
        with open(os.path.join(EXAMPLES, self.model), encoding="utf-8") as file:
            text = file.read()
        with open(model, "w", encoding="utf-8") as file:
            file.write(text.replace("gravity: [0, 0, -9.81]\n", ""))
        subprocess.run([PROGRAM, model, "-o", target, "--quiet"], check=True, timeout=100)
        with_gravity, without = two_blades.modes(self.path), two_blades.modes(target)
        self.assertEqual(len(without), 3)
        self.assertGreater(max(abs(a - b) for a, b in zip(with_gravity, without)), 1e-3)


if __name__ == "__main__":
    unittest.main()
