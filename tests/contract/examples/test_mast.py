"""Compares stresses of mechanism/examples/mast.yaml under wind with elementary beam theory.

The top moves by a few centimetres, so that the weight on the displaced mast changes the moments by less than 2 %.
"""

import unittest

import numpy as np

from example import ExampleTest

HEIGHT, ELEMENTS = 12.0, 12


def wind(z):
    s = z / HEIGHT
    return 700 * (0.40 - 0.20 * s) * (0.3 + 0.7 * s)


def wind_moment(z):
    """Returns the moment, about the height z, of the wind above it."""
    above = np.linspace(z, HEIGHT, 2001)
    return np.trapz(wind(above) * (above - z), above)


class Mast(ExampleTest):
    model = "mast.yaml"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.static = cls.results.file["analysis_1"]
        cls.z = (np.arange(ELEMENTS) + 0.5) * HEIGHT / ELEMENTS

    def test_moments_are_those_of_the_wind_above(self):
        moments = self.static["elements/mast/resultants"][-1, :, 5]
        expected = np.array([wind_moment(z) for z in self.z])
        # The section's y points along the wind, so that M_z is positive. The weight adds up to 2 %.
        np.testing.assert_allclose(moments, expected, atol=0.03 * expected[0])

    def test_corners_carry_the_stress_of_bending_and_weight(self):
        resultants = self.static["elements/mast/resultants"][-1]
        stress = self.static["elements/mast/stress"][-1]
        self.assertEqual(stress.shape, (ELEMENTS, 2, 3))
        s = self.z / HEIGHT
        width, wall = 0.40 - 0.20 * s, 0.008 - 0.003 * s
        inner = width - 2 * wall
        area, inertia = width ** 2 - inner ** 2, (width ** 4 - inner ** 4) / 12
        for point, y in ((0, width / 2), (1, -width / 2)):
            expected = resultants[:, 0] / area + resultants[:, 4] * (width / 2) / inertia - resultants[:, 5] * y / inertia
            np.testing.assert_allclose(stress[:, point, 0], expected, rtol=1e-9, atol=1)
        tau2 = (stress[:, :, 1:] ** 2).sum(axis=2)
        np.testing.assert_allclose(self.static["elements/mast/von_mises"][-1],
                                   np.sqrt(stress[:, :, 0] ** 2 + 3 * tau2), rtol=1e-12)

    def test_the_gust_sways_the_mast_and_the_books_close(self):
        top = self.results.rows("nodes/top/position")[:, 0]
        still = self.static["nodes/top/position"][-1, 0]
        self.assertAlmostEqual(top[0], still, delta=1e-6)
        # The static response to the gust is 40 % larger; the gust rises within about one period, and the mast
        # overshoots.
        self.assertGreater(top.max(), 1.4 * still)
        self.assertLess(top.max(), 1.9 * still)
        self.assertLess(abs(top[-1] - still), 0.25 * still)
        moved = self.results.rows("energy/input")
        self.assertLess(np.abs(self.results.rows("energy/balance")).max(), 2e-2 * np.abs(moved).max())


if __name__ == "__main__":
    unittest.main()
