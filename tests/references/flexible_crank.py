"""A slider-crank with a flexible rod: deflection of its middle from the line between its ends, and the slider.

Data of the problem "crank" (B. Simeon) of the IVP test set: crank 0.15 m at 150 rad/s, rod 0.3 m of 8 x 8 mm, E = 2e11,
nu = 0.3, 7870 kg/m^3, slider 0.075552 kg. The rod is geometrically exact (shear factor 5/6), by a spectral element and
Gauss' collocation in time. It begins either straight with the velocities of a rigid rod, or as in the test set, with
small axial vibrations.
"""
import numpy as np

import dynamic_rods
import table

r, speed, L, slider = 0.15, 150, 0.3, 0.075552
E, A, rho = 2e11, 64e-6, 7870
I = A * A / 12


class Crank:
    def __init__(self, nodes):
        self.rod = dynamic_rods.PlaneRod(L, nodes, E * A, 5 / 6 * E / 2.6 * A, E * I, rho * A, rho * I)
        self.nodes = nodes
        self.mass = self.rod.mass.copy()
        self.mass[0, -1] += slider
        self.x = self.rod.element.s / L
        self.free = [k for k in range(3 * nodes) if k not in (0, nodes, 2 * nodes - 1)]

    def rigid_start(self):
        q = self.rod.straight((r, 0))
        return q, np.array([0 * self.x, 22.5 * (1 - self.x), -75 + 0 * self.x])

    def smooth_start(self):
        x, turning, a, b = self.x, -74.9957670, 0.444896105, 0.463434311e-2

        def parabola(middle, end):
            return 4 * x * (1 - x) * middle + x * (2 * x - 1) * end
        stretch = parabola(0.103339863e-4, 0.169327969e-4)
        q = self.rod.straight((r, 0))
        q[0] += stretch
        v = np.array([parabola(-0.178591076e-5, -0.268938672e-5),
                      22.5 + turning * (L * x + stretch) + a * np.sin(np.pi * x) + b * np.sin(2 * np.pi * x),
                      turning + np.pi / L * (a * np.cos(np.pi * x) + 2 * b * np.cos(2 * np.pi * x))])
        return q, v

    def full(self, t, free):
        """Returns all nodes: the first one moves with the crank, and the last one stays on y = 0."""
        q = np.zeros((len(free), 3 * self.nodes), free.dtype)
        q[:, self.free] = free
        q[:, 0], q[:, self.nodes] = r * np.cos(speed * t), r * np.sin(speed * t)
        return q.reshape(len(free), 3, -1)

    def acceleration(self, t, free, _):
        return (self.rod.forces(self.full(t, free)) / self.mass).reshape(len(free), -1)[:, self.free]

    def run(self, start, h=1e-5):
        """Returns the deflections of the middle at the ends of steps, and the slider's position at the end."""
        solver = dynamic_rods.Gauss(self.acceleration, h, 1e-4)
        q, v = (f.ravel()[self.free] for f in start)
        found = []
        for k in range(round(0.1 / h)):
            q, v = solver.step(k * h, q, v)
            first, middle, last = self.full((k + 1) * h, q[None])[0][:2, [0, self.nodes // 2, -1]].T
            along = (last - first) / np.linalg.norm(last - first)
            found.append(along[0] * (middle - first)[1] - along[1] * (middle - first)[0])
        return np.array(found), last[0]


def fill(rows):
    # Axial vibrations, which the first start excites, determine the number of nodes.
    for name, begin, claimed in (("rigid_start", Crank.rigid_start, 5e-7), ("smooth_start", Crank.smooth_start, 5e-8)):
        (w, place), (other, other_place) = (crank.run(begin(crank)) for crank in (Crank(13), Crank(11)))
        if np.abs(w - other)[1999::2000].max() > claimed or abs(place - other_place) > 2 * claimed:
            raise ArithmeticError(f"two meshes differ by more than {claimed:g}")
        rows.add(f"{name}.highest", w.max(), claimed, "deflection [m]")
        rows.add(f"{name}.lowest", w.min(), claimed, "deflection [m]")
        for k in range(1, 6):
            rows.add(f"{name}.at_{k}", w[2000 * k - 1], claimed, f"deflection at {0.02 * k:g} s [m]")
        rows.add(f"{name}.slider", place, 2 * claimed, "at 0.1 s [m]")


if __name__ == "__main__":
    table.run(fill, __file__)
