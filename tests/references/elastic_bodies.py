"""Frequencies of elastic bodies in closed form, by their dispersion relations: a thick plate, and a sphere.

The plate of 10 x 10 x 1 m (E = 200 GPa, nu = 0.3, 8000 kg/m^3) is simply supported: Lamb waves fit between its sides
with k = pi sqrt(m^2 + n^2)/10. The sphere has the radius 1 m (E = 210 GPa, nu = 0.3, 7800 kg/m^3; H. Lamb, Proc. London
Math. Soc. 13 (1882) 189).
"""
import mpmath
from mpmath import mpf, pi, sqrt

import table


def plate(rows):
    E, nu, rho, half, side = mpf(200e9), mpf("0.3"), mpf(8000), mpf("0.5"), mpf(10)
    G = E / (2 * (1 + nu))
    c_t, c_l = sqrt(G / rho), sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * rho))

    def functions(k):
        def split(omega):
            p2, q2 = omega**2 / c_l**2 - k * k, omega**2 / c_t**2 - k * k
            return mpmath.sqrt(mpmath.mpc(p2)), mpmath.sqrt(mpmath.mpc(q2)), q2

        # Both are even in p and q, hence real. Divided by p or q they have no additional roots at p = 0 or q = 0.
        def bending(omega):
            p, q, q2 = split(omega)
            a, b = p * half, q * half
            return mpmath.re((q2 - k * k)**2 * mpmath.sin(a) * mpmath.cos(b) / p
                             + 4 * k * k * q * mpmath.cos(a) * mpmath.sin(b))

        def stretching(omega):
            p, q, q2 = split(omega)
            a, b = p * half, q * half
            return mpmath.re((q2 - k * k)**2 * mpmath.cos(a) * mpmath.sin(b) / q
                             + 4 * k * k * p * mpmath.sin(a) * mpmath.cos(b))
        return bending, stretching

    found = []
    for m in range(4):
        for n in range(4):
            if m + n == 0:
                continue
            k = pi * mpf(m * m + n * n)**mpf("0.5") / side
            # The deflection is a product of sines, which is zero unless there are waves in both directions.
            for function in functions(k) if m * n else ():
                lines = [2 * pi * mpf(f) for f in range(5, 231, 5)]
                values = [function(omega) for omega in lines]
                for a, b, before, after in zip(lines, lines[1:], values, values[1:]):
                    if before * after < 0:
                        found.append(mpmath.findroot(function, (a, b), solver="anderson", tol=1e-30) / (2 * pi))
            # Horizontal shear moves only along the sides: there is one such wave for m and n from 0 on, unless both are
            # 0.
            shear = k * c_t / (2 * pi)
            if shear < 230:
                found.append(shear)
    for k, f in enumerate(sorted(found)[:9]):
        rows.add(f"plate_{k + 1}", f, 1e-10, "frequency [Hz]")


def sphere(rows):
    E, nu, rho = mpf(210e9), mpf("0.3"), mpf(7800)
    G = E / (2 * (1 + nu))
    c_t, c_l = sqrt(G / rho), sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * rho))

    def j(n, x):
        return sqrt(pi / (2 * x)) * mpmath.besselj(n + mpf("0.5"), x)
    # Torsion of degree 2 has no shear stress on the surface, (n - 1) j_n = x j_(n+1).
    x = mpmath.findroot(lambda x: j(2, x) - x * j(3, x), (mpf("2.3"), mpf("2.7")), solver="anderson", tol=1e-30)
    rows.add("sphere.torsion_root", x, 1e-12, "omega R sqrt(rho/G)")
    rows.add("sphere.torsion", x * c_t / (2 * pi), 1e-9, "frequency [Hz]")
    # The breathing mode has u = j_1(k r) outwards, and (lambda + 2 G) u' + 2 lambda u/r = 0 at r = 1.
    ratio = nu / (1 - nu)  # lambda/(lambda + 2 G)
    x = mpmath.findroot(lambda x: mpmath.diff(lambda r: j(1, x * r), 1) + 2 * ratio * j(1, x), (mpf(2), mpf(3)),
                        solver="anderson", tol=1e-20)
    rows.add("sphere.breathing", x * c_l / (2 * pi), 1e-9, "frequency [Hz]")


def fill(rows):
    mpmath.mp.dps = 40
    plate(rows)
    sphere(rows)


if __name__ == "__main__":
    table.run(fill, __file__)
