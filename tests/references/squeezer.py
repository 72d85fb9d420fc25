"""Andrews' squeezing mechanism: seven bodies in a plane, driven by 0.033 N m from rest.

Data: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), section VII.7. DOP853 integrates in
Cartesian coordinates of the seven bodies; angles are those of the source.
"""
import numpy as np

import linkage
import table

START = {"beta": -0.0617138900142764496, "theta": 0, "gamma": 0.455279819163070380, "phi": 0.222668390165885885,
         "delta": 0.487364979543842550, "Omega": -0.222668390165885885, "epsilon": 1.23054744454982119}


def mechanism():
    """The bodies in the order beta, theta, gamma, phi, delta, Omega, epsilon, and their positions at the start."""
    link = linkage.Linkage()
    quarter = np.pi / 2
    s = START
    # Angle of each body's x axis, mass, inertia about the centre, centre of mass from its joint.
    bodies = [(s["beta"], 0.04325, 2.194e-6, [0.00092, 0]),
              (s["beta"] + s["theta"] + np.pi, 0.00365, 4.410e-7, [0.0115, 0]),
              (s["gamma"] - quarter, 0.02373, 5.255e-6, [0.01874, 0.01043]),
              (s["phi"] + s["delta"] - quarter, 0.00706, 5.667e-7, [0.00579, 0]),
              (s["delta"], 0.07050, 1.169e-5, [0.02308, 0.00916]),
              (s["Omega"] + s["epsilon"], 0.00706, 5.667e-7, [0.00579, 0]),
              (s["epsilon"] - quarter, 0.05498, 1.912e-5, [0.01228, 0.00449])]
    centres = [np.array(body[3]) for body in bodies]
    for _, mass, inertia, _ in bodies:
        link.body(mass, inertia)

    def pin(first, at_first, second, at_second):
        link.pin(first, np.array(at_first) - (0 if first is None else centres[first]),
                 second, np.array(at_second) - (0 if second is None else centres[second]))

    A, B, C, O = [-0.06934, -0.00227], [-0.03635, 0.03273], [0.014, 0.072], [0, 0]
    pin(None, O, 0, [0, 0])
    pin(0, [0.007, 0], 1, [0, 0])
    pin(None, B, 2, [0, 0])
    # Point F at the end of the bar belongs to three bodies.
    pin(1, [0.028, 0], 2, [0.035, 0])
    pin(1, [0.028, 0], 3, [0.02, 0])
    pin(1, [0.028, 0], 5, [0.02, 0])
    pin(None, A, 4, [0, 0])
    pin(4, [0.04, 0], 3, [0, 0])
    pin(None, A, 6, [0, 0])
    pin(6, [0.04, 0], 5, [0, 0])
    link.torques = {0: 0.033}
    link.spring = (np.array(C), 2, np.array([0.018, 0.02]) - centres[2], 4530, 0.07785)

    # Positions of the joints of the bodies.
    P = linkage.turned(s["beta"], [0.007, 0])
    G = A + linkage.turned(s["delta"], [0.04, 0])
    H = A + linkage.turned(s["epsilon"] - quarter, [0.04, 0])
    z = []
    for (angle, _, _, centre), joint in zip(bodies, (O, P, B, G, A, H, A)):
        z += [*(joint + linkage.turned(angle, centre)), angle]
    return link, link.assembled(z, keep=[2])


def fill(rows):
    link, z = mechanism()
    acceleration, _ = link.solve(z, np.zeros(21))
    turning = acceleration[2::3]
    rows.add("start.beta", turning[0], 1e-7, "angular acceleration of the crank at rest [rad/s^2]")
    rows.add("start.theta", turning[1] - turning[0], 1e-7, "angular acceleration of bar 2 against the crank [rad/s^2]")
    positions, _ = link.move(z, np.zeros(21), [0.03, 0.05])
    for time, place in zip((30, 50), positions):
        b = place[2::3]
        angles = {"beta": b[0], "theta": b[1] - b[0] - np.pi, "gamma": b[2] + np.pi / 2,
                  "phi": b[3] - b[4] + np.pi / 2, "delta": b[4], "Omega": b[5] - b[6] - np.pi / 2,
                  "epsilon": b[6] + np.pi / 2}
        for name, angle in angles.items():
            rows.add(f"at_{time}_ms.{name}", angle, 1e-10, f"angle at {time / 1000} s [rad]")


if __name__ == "__main__":
    table.run(fill, __file__)
