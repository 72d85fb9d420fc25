"""A rigid slider-crank: crank 0.15 m, rod 0.3 m, data of the problem "crank" (B. Simeon) of the IVP test set.

It uses Cartesian coordinates of crank, rod and slider. The multiplier of a constant speed gives the torque; DOP853
integrates free motions.
"""
import numpy as np

import linkage
import table


def mechanism(gravity, centre):
    """@param centre  place of the crank's centre of mass along it [m]; its inertia about the pivot is 0.002727 kg m^2"""
    link = linkage.Linkage(gravity)
    crank = link.body(0.36, 0.002727 - 0.36 * centre**2)
    rod = link.body(0.151104, 0.00113328)
    slider = link.body(0.075552, 1.0)  # the slider does not rotate
    link.pin(None, [0, 0], crank, [-centre, 0])
    link.pin(crank, [0.15 - centre, 0], rod, [-0.15, 0])
    link.pin(rod, [0.15, 0], slider, [0, 0])
    link.guide(slider)
    return link


def placed(link, angle, centre):
    """Returns the positions for an angle of the crank, with the slider on the far side."""
    tilt = -np.arcsin(0.5 * np.sin(angle))
    pin, half = linkage.turned(angle, [0.15, 0]), linkage.turned(tilt, [0.15, 0])
    z = np.array([*linkage.turned(angle, [centre, 0]), angle, *(pin + half), tilt, *(pin + 2 * half), 0])
    # The guide holds the angle of the slider, and the pins hold other coordinates: one coordinate is free.
    return link.assembled(z, keep=[2])


def fill(rows):
    link = mechanism(0, 0)
    for degrees in (30, 90):
        angle = np.radians(degrees)
        held = mechanism(0, 0)
        held.held = [0]
        z = placed(held, angle, 0)
        v = link.velocities(z, 2, 150)
        _, multipliers = held.solve(z, v)
        rows.add(f"torque_{degrees}", multipliers[-1], 1e-8, f"torque that holds 150 rad/s at {degrees} degrees [N m]")

    z = placed(link, 0, 0)
    positions, _ = link.move(z, link.velocities(z, 2, 150), [0.1])
    rows.add("free.slider", positions[0][6], 1e-10, "slider at 0.1 s from 150 rad/s in line [m]")

    link = mechanism(9.81, 0.075)
    link.torques = {0: 0.05}
    positions, rates = link.move(placed(link, np.pi / 4, 0.075), np.zeros(9), [1, 2])
    for k in (1, 2):
        rows.add(f"swinging.angle_{k}", positions[k - 1][2], 1e-9, f"angle of the crank at {k} s [rad]")
        rows.add(f"swinging.rate_{k}", rates[k - 1][2], 1e-8, f"rate of the crank at {k} s [rad/s]")
    rows.add("swinging.slider_2", positions[1][6], 1e-10, "slider at 2 s [m]")


if __name__ == "__main__":
    table.run(fill, __file__)
