"""The flying spaghetti: J. Simo, L. Vu-Quoc, J. Appl. Mech. 53 (1986) 855; Comput. Methods Appl. Mech. Eng. 66 (1988)
125.

A free rod of length 10, with EA = GA = 1e4, mass 1 and mass moments 10 per length, is at rest from A = (6, 0, 0) to B =
(0, 8, 0). The load T at A rises to its peak at 2.5 s and is zero from 5 s on. In the plane it is a force T/10 along x
and a moment -T about z with the peak 80; in space it is a moment (0, -T/2, -T) with the peak 200. The method is one
spectral element, with DOP853 in time. The kinks of T excite waves of any length, so that errors decrease only with a
power of the number of nodes; two numbers of nodes give their size.
"""
import numpy as np
from scipy.integrate import solve_ivp

import dynamic_rods
import table

R = np.array([[-0.6, -0.8, 0], [0.8, -0.6, 0], [0, 0, 1]])


def march(rate, z, peak, times):
    """Returns the states at the times. @param rate  of (T, z)"""
    found, start = {}, 0
    for end, thrust in ((2.5, lambda t: peak * t / 2.5), (5, lambda t: peak * (2 - t / 2.5)), (times[-1], lambda t: 0)):
        if end <= start:
            continue
        wanted = [t for t in times if start < t <= end]
        solution = solve_ivp(lambda t, y, T=thrust: rate(T(t), y), (start, end), z, method="DOP853", rtol=1e-8,
                             atol=1e-8, t_eval=sorted({*wanted, end}))
        for t in wanted:
            found[t] = solution.y[:, list(solution.t).index(t)]
        z, start = solution.y[:, -1], end
    return found


class Plane:
    def __init__(self, EI, nodes):
        self.rod = dynamic_rods.PlaneRod(10, nodes, 1e4, 1e4, EI, 1, 10)
        self.shape = (2, 3, nodes)

    def fly(self, peak, times):
        q = self.rod.straight((6, 0), np.arctan2(0.8, -0.6))

        def rate(T, y):
            q, v = y.reshape(self.shape)
            F = self.rod.forces(q)
            F[:, 0] += [0.1 * T, 0, -T]
            return np.concatenate([v.ravel(), (F / self.rod.mass).ravel()])
        return {t: y.reshape(self.shape) for t, y in march(rate, np.concatenate([q.ravel(), 0 * q.ravel()]), peak,
                                                          times).items()}

    def place(self, z, node):
        return np.array([*z[0, :2, node], 0])

    def middle(self, z):
        return [self.rod.element.value(z[0, 0], 5), self.rod.element.value(z[0, 1], 5), 0]

    def momentum(self, z):
        """The moment is about the origin."""
        p = self.rod.mass * z[1]
        return np.array([0, 0, (z[0, 0] * p[1] - z[0, 1] * p[0] + p[2]).sum()])

    def energy(self, z):
        return self.rod.energy(*z)


class Space:
    def __init__(self, EI, nodes):
        self.rod = dynamic_rods.SpaceRod(10, nodes, 1e4, 1e4, EI, EI, 1, [10, 10, 10])
        self.shape = (18, nodes)

    def fly(self, peak, times):
        def rate(T, y):
            load, moment = np.array([0.1 * T, 0, 0]), np.array([0, -0.5 * T, -T])
            return self.rod.rate(y.reshape(self.shape), load, moment).ravel()
        return {t: y.reshape(self.shape) for t, y in march(rate, self.rod.straight([6, 0, 0], R).ravel(), peak,
                                                          times).items()}

    def place(self, z, node):
        return z[:3, node]

    def momentum(self, z):
        """The moment is about the origin."""
        w, x, v = self.rod.element.weight, z[:3], z[12:15]
        spin = np.einsum("ijn,jn->in", z[3:12].reshape(3, 3, -1), self.rod.J * z[15:])
        return (w * (np.cross(x, self.rod.mass * v, axis=0) + spin)).sum(1)

    def energy(self, z):
        return self.rod.energy(z)


def add(rows, name, kind, EI, peak, times, nodes, within):
    """@param nodes  numbers of nodes of the reference and of a coarser mesh, which must agree within the claim"""
    model, rough = kind(EI, nodes[0]), kind(EI, nodes[1])
    found, others = model.fly(peak, times), rough.fly(peak, times)
    for t in times:
        for end, node in (("a", 0), ("b", -1)):
            place = model.place(found[t], node)
            apart = np.abs(place - rough.place(others[t], node)).max()
            if apart > within:
                raise ArithmeticError(f"{name}, t = {t}: two meshes are {apart:g} apart")
            rows.add_vector(f"{name}.{t}.{end}", place, within, f"end {end} at {t} s")
    after = found[times[-1]]
    rows.add_vector(f"{name}.momentum", model.momentum(after), 1e-3, "about the origin when the loads have gone")
    rows.add(f"{name}.energy", model.energy(after), 5e-2, "when the loads have gone")
    if kind is Plane:
        rows.add_vector(f"{name}.{times[-1]}.middle", model.middle(after), within, f"middle at {times[-1]} s")


def fill(rows):
    add(rows, "plane_100", Plane, 100, 80, [5, 10, 15], (40, 28), 1e-4)
    add(rows, "plane_500", Plane, 500, 80, [5, 10, 15], (40, 28), 5e-5)
    add(rows, "space", Space, 500, 200, [3.5, 5, 8, 10], (24, 16), 1e-4)


if __name__ == "__main__":
    table.run(fill, __file__)
