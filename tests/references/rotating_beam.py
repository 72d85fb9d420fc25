"""Out-of-plane frequencies of a rotating cantilever: mu = omega sqrt(m L^4/EI).

A. Wright, C. Smith, R. Thresher, J. Wang, J. Appl. Mech. 49 (1982) 197: Bernoulli's beam without rotary inertia,
    w'''' - eta^2 (T w')' = mu^2 w,   T = (1 - x^2)/2 + hub (1 - x),
clamped at 0, free at 1. Its solutions are power series about the root. Two of them satisfy the clamping, and the
determinant of bending moment and shear at the tip is zero at a frequency. The computation has 60 digits, since terms of
the series cancel.
"""
import mpmath
from mpmath import mpf

import table


def solution(eta2, hub, mu2, second, third):
    """Returns w'' and w''' at the tip of the solution that begins with given w'' and w'''."""
    a = [mpf(0), mpf(0), second / mpf(2), third / mpf(6)]
    # The term is (T w')' with T = t_0 + t_1 x + t_2 x^2.
    t = [mpf(1) / 2 + hub, -hub, -mpf(1) / 2]
    n = 0
    while n < 60 or abs(a[-1]) + abs(a[-2]) > mpf(10)**-50:
        # The coefficient of x^n in (T w')' is (n + 1) sum_k t_k (n + 2 - k) a_(n + 2 - k).
        tension = (n + 1) * sum(t[k] * (n + 2 - k) * a[n + 2 - k] for k in range(3) if n + 2 - k > 0)
        a.append((mu2 * a[n] + eta2 * tension) / ((n + 4) * (n + 3) * (n + 2) * (n + 1)))
        n += 1
    return (sum(k * (k - 1) * c for k, c in enumerate(a)), sum(k * (k - 1) * (k - 2) * c for k, c in enumerate(a)))


def frequencies(eta, hub, count):
    eta2, hub = mpf(eta)**2, mpf(hub)

    def determinant(mu):
        first, second = solution(eta2, hub, mu**2, 1, 0), solution(eta2, hub, mu**2, 0, 1)
        return first[0] * second[1] - first[1] * second[0]

    found, mu, step = [], mpf("0.5"), mpf("0.5")
    before = determinant(mu)
    while len(found) < count:
        after = determinant(mu + step)
        if before * after < 0:
            found.append(mpmath.findroot(determinant, (mu, mu + step), solver="anderson", tol=1e-40))
        mu, before = mu + step, after
    return found


def fill(rows):
    mpmath.mp.dps = 60
    for eta in (0, 1, 2, 3, 4, 5, 6, 8, 10, 12):
        for k, mu in enumerate(frequencies(eta, 0, 2)):
            rows.add(f"{eta}.flap_{k + 1}", mu, 1e-10, f"frequency at eta = {eta} without hub")
    rows.add("12.hub.flap_1", frequencies(12, 1, 1)[0], 1e-9, "frequency at eta = 12 with a hub of one length")


if __name__ == "__main__":
    table.run(fill, __file__)
