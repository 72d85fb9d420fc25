"""The stiff flyball governor of the IFToMM library (A05).

A shaft of 1 m turns about z. At its top, 0.05 m from the axis, two arms of 1 m with balls of 5 kg at their ends swing
in the plane of the shaft. The middle of each arm is connected to a slider on the shaft, 0.05 m from its axis, by a
stiff spring and damper. Bars have a section of 0.01 x 0.01 m, the slider is a cube of 0.1 m, and the density is 3000
kg/m^3. At the start the arms are 30 degrees below the horizontal, the slider is at s = 0.5 m, and everything rotates
with 2 pi rad/s about z; springs are unstressed.

The coordinates are psi (rotation), th (angle of both arms from the downward vertical) and s. With the distance r(u) = e
+ u sin th of a point of an arm from the axis, the kinetic energy is psidot^2 Z(th)/2 + thdot^2 A + M sdot^2/2, so that
Z psidot is constant.
"""
import numpy as np

import motion
import table

G, ARM, OFFSET, BALL, DENSITY, STIFFNESS, DAMPING, FREE = 9.81, 1.0, 0.05, 5.0, 3000.0, 8e5, 4e4, 0.5
BAR, CUBE = DENSITY * 1e-4, DENSITY * 1e-3            # masses of a bar and of the slider [kg]
THIN = 1e-4                                           # square of the bars' width [m^2]
ABOUT_PIVOT = BAR * ARM**2 / 3 + BAR * THIN / 12 + BALL * ARM**2  # inertia of an arm about its hinge [kg m^2]
FIRST = BAR * ARM / 2 + BALL * ARM                    # its first moment [kg m]


def turning_inertia(th):
    """Returns Z and dZ/dth, where Z is the inertia of both arms, the shaft and the slider about z."""
    s, c = np.sin(th), np.cos(th)
    # The inertia of one arm is the sum of m (e + u sin th)^2 over its axis, plus that of its thickness.
    lines = (BAR + BALL) * OFFSET**2 + 2 * OFFSET * FIRST * s + (BAR * ARM**2 / 3 + BALL * ARM**2) * s**2
    thick = BAR * THIN / 12 * (1 + c**2)
    fixed = BAR * THIN / 6 + CUBE * 0.01 / 6
    slope = 2 * OFFSET * FIRST * c + 2 * (BAR * ARM**2 / 3 + BALL * ARM**2) * s * c - 2 * BAR * THIN / 12 * c * s
    return 2 * (lines + thick) + fixed, 2 * slope


def spring(th, thdot, s, sdot):
    """Returns the force of one spring (tension positive), and the derivatives of its length by th and s."""
    x, z = 0.5 * ARM * np.sin(th), 1.0 - 0.5 * ARM * np.cos(th) - s
    length = np.hypot(x, z)
    by_th, by_s = (x * 0.5 * ARM * np.cos(th) + z * 0.5 * ARM * np.sin(th)) / length, -z / length
    return STIFFNESS * (length - FREE) + DAMPING * (by_th * thdot + by_s * sdot), by_th, by_s


def fill(rows):
    start = np.radians(60)
    momentum = turning_inertia(start)[0] * 2 * np.pi

    def rate(_, z):
        _, th, s, thdot, sdot = z
        Z, slope = turning_inertia(th)
        psidot = momentum / Z
        force, by_th, by_s = spring(th, thdot, s, sdot)
        thddot = (0.5 * slope * psidot**2 - 2 * G * FIRST * np.sin(th) - 2 * force * by_th) / (2 * ABOUT_PIVOT)
        return np.array([psidot, thdot, sdot, thddot, -G - 2 * force * by_s / CUBE])

    times = [0.1, 1.0, 5.0, 10.0]
    for t, z in zip(times, motion.integrate(rate, [0.0, start, 0.5, 0.0, 0.0], times, agree=1e-8, rtol=1e-11,
                                            atol=1e-13)):
        rows.add(f"{t:g}.s", z[2], 1e-8, f"place of the slider on the shaft at {t:g} s [m]")
        rows.add(f"{t:g}.arm", z[1], 1e-8, f"angle of the arms from the downward vertical at {t:g} s [rad]")
        rows.add(f"{t:g}.turn", z[0], 1e-7, f"angle of the shaft at {t:g} s [rad]")


if __name__ == "__main__":
    table.run(fill, __file__)
