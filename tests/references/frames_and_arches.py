"""Paths and limit points of Lee's frame, of a deep and of a shallow arch, by shooting: Reissner's rod.

S. Lee, F. Manuel, E. Rossow, J. Eng. Mech. Div. ASCE 94 (1968); D. DaDeppo, R. Schmidt, J. Appl. Mech. 42 (1975) 923.
P is the downward load, u and v are the displacements of its point along x and down. The path is followed by its arc
length; P has its extrema at limit points.
"""
import numpy as np

import rods
import table


class LeesFrame:
    """Column and beam have the length 120, EA = 4320, EI = 1440 and pinned ends; the load is 24 from the corner.

    The unknowns are angle and forces at the foot, and P.
    """
    size = np.array([1, 2, 2, 2])
    start = np.array([np.pi / 2, 0, 0, 0])

    def __init__(self, GA):
        self.rod = rods.Plane(1440, 4320, GA)

    def to_load(self, u):
        zero = 0 * u[0]
        z = self.rod.advance(np.array([zero, zero, u[0], zero]), (u[1], u[2]), 120, steps=16)
        z = np.array([z[0], z[1], z[2] - np.pi / 2, z[3]])
        return self.rod.advance(z, (u[1], u[2]), 24, steps=4)

    def gap(self, u):
        z = self.rod.advance(self.to_load(u), (u[1], u[2] + u[3]), 96, steps=14)
        return np.array([z[0] / 120 - 1, z[1] / 120 - 1, z[3] / 100])

    def moved(self, u):
        z = self.to_load(u[:, None])[:, 0].real
        return z[0] - 24, 120 - z[1]


class DeepArch:
    """The arch has 215 degrees, the radius 100 and EI = 1e6; it is clamped at the left, hinged at the right, and loaded
    at the top.

    The unknowns are moment and forces at the clamp, and P.
    """
    size = np.array([2e4, 500, 500, 500])
    start = np.zeros(4)
    half = np.radians(107.5)

    def __init__(self, EA, GA):
        self.rod = rods.Plane(1e6, EA, GA)

    def half_arch(self, z, force):
        return self.rod.advance(z, force, 100 * self.half, curvature=-0.01, steps=32)

    def to_load(self, u):
        zero = 0 * u[0]
        z = np.array([zero - 100 * np.sin(self.half), zero + 100 * np.cos(self.half), zero + self.half, u[0]])
        return self.half_arch(z, (u[1], u[2]))

    def gap(self, u):
        z = self.half_arch(self.to_load(u), (u[1], u[2] + u[3]))
        return np.array([z[0] / 100 - np.sin(self.half), z[1] / 100 - np.cos(self.half), z[3] / 2e4])

    def moved(self, u):
        z = self.to_load(u[:, None])[:, 0].real
        return z[0], 100 - z[1]


class ShallowArch:
    """The left half of a symmetric arch with span 100, rise 5, EA = 1e6 and EI = 1e6/12, which is hinged at both ends
    and loaded at the crown.

    The unknowns are the angle at the hinge, the horizontal force, and P.
    """
    size = np.array([0.1, 500, 50])
    radius = 252.5
    half = np.arcsin(50 / 252.5)
    start = np.array([half, 0, 0])

    def __init__(self, GA):
        self.rod = rods.Plane(1e6 / 12, 1e6, GA)

    def half_arch(self, z, force):
        return self.rod.advance(z, force, self.radius * self.half, curvature=-1 / self.radius, steps=16)

    def crown(self, u):
        zero = 0 * u[0]
        return self.half_arch(np.array([zero - 50, zero, u[0], zero]), (u[1], -0.5 * u[2]))

    def gap(self, u):
        z = self.crown(u)
        return np.array([z[0] / 50, z[2]])

    def moved(self, u):
        z = self.crown(u[:, None])[:, 0].real
        return z[0], 5 - z[1]

    def stability(self, u):
        """Returns the determinant of the whole arch, which may move sideways, divided by that of the symmetric half."""
        def whole(w):
            zero = 0 * w[0]
            z = self.half_arch(np.array([zero - 50, zero, w[0], zero]), (w[1], w[2]))
            z = self.half_arch(z, (w[1], w[2] + u[2]))
            return np.array([z[0] / 50, z[1] / 50, z[3] / 1e4])
        _, J = rods.with_jacobian(whole, [u[0], u[1], -0.5 * u[2]])
        return np.linalg.det(J * np.array([0.1, 500, 50]))


class Curve:
    """Returns a path, and the requested points on it."""

    def __init__(self, model, length, step=0.1):
        self.model = model
        self.path = rods.Path(model.gap, model.size, model.start, len(model.size) - 1, length, step)

    def where(self, value):
        return self.path.zeros(value)

    def limits(self):
        return self.where(lambda u, t: t[-1])

    def first(self, value):
        return self.where(lambda u, t: value(u))[0]

    def at_load(self, P):
        return self.first(lambda u: u[-1] - P)

    def at(self, component, displacement):
        return self.first(lambda u: self.model.moved(u)[component] - displacement)


def add_point(rows, name, model, u, P=1e-9, displacement=1e-7):
    """@param P,displacement  claimed accuracy"""
    rows.add(f"{name}.P", u[-1], P, "load")
    for component, moved in zip("uv", model.moved(u)):
        if not (component == "u" and isinstance(model, ShallowArch)):
            rows.add(f"{name}.{component}", moved, displacement, "displacement")


def fill(rows):
    GA = 4320 / 2.6
    for name, shear in (("lee", GA), ("lee_reduced_shear", 5 / 6 * GA), ("lee_without_shear", np.inf)):
        frame = LeesFrame(shear)
        curve = Curve(frame, 12)
        for which, u in zip(("first", "second"), curve.limits()[:2], strict=True):
            add_point(rows, f"{name}.{which}", frame, u, displacement=1e-6)
        if shear != GA:
            continue
        for k, P in enumerate((0.604018511292, 1.410408115941, 1.738618841387)):
            add_point(rows, f"lee.load_{k + 1}", frame, curve.at_load(P))
        # Displacements are positive to the right and down.
        for k, (component, displacement) in enumerate(((0, 6.293514103106), (0, 73.653814113660), (0, 82.508173957958),
                                                       (1, 64.479705604899), (1, 90.549538712821))):
            add_point(rows, f"lee.end_{k + 1}", frame, curve.at(component, displacement))

    arch = DeepArch(1e8, 5e7)
    curve = Curve(arch, 9)
    for which, u in zip(("first", "second"), curve.limits()[:2], strict=True):
        add_point(rows, f"deep.{which}", arch, u, P=1e-6, displacement=1e-5)
    for k, P in enumerate((129.2616799121, 704.6534988680, 855.9577692765)):
        add_point(rows, f"deep.load_{k + 1}", arch, curve.at_load(P), P=1e-6)
    add_point(rows, "deep.end", arch, curve.at(0, 64.6131898710), P=1e-6)
    arch = DeepArch(np.inf, np.inf)
    rows.add("deep_stiff.first.P", Curve(arch, 6).limits()[0][-1], 1e-6, "load")

    for name, shear in (("shallow", np.inf), ("shallow_shear", 5 / 6 * 1e6 / 2.6)):
        arch = ShallowArch(shear)
        curve = Curve(arch, 14)
        limits = curve.limits()
        add_point(rows, f"{name}.upper", arch, limits[0], P=1e-7, displacement=1e-6)
        add_point(rows, f"{name}.lower", arch, limits[1], P=1e-6, displacement=1e-5)
        add_point(rows, f"{name}.sideways", arch, curve.first(arch.stability), P=1e-6, displacement=1e-6)


if __name__ == "__main__":
    table.run(fill, __file__)
