"""A free body that spins about its intermediate axis: J = diag(1, 2, 3) kg m^2, Omega(0) = (0.01, 5, 0.01) rad/s.

Closed form by Jacobi's elliptic functions (L. D. Landau, E. M. Lifshitz, Mechanics, section 37), with 40 digits. The
energy 2 E = sum J_k Omega_k^2 and the angular momentum M^2 = sum (J_k Omega_k)^2 satisfy M^2 > 2 E J_2:
    Omega_1 = a cn(tau), Omega_2 = b sn(tau), Omega_3 = c dn(tau).
"""
import mpmath
from mpmath import mpf, sqrt

import table

J = [mpf(1), mpf(2), mpf(3)]
start = [mpf("0.01"), mpf(5), mpf("0.01")]


def fill(rows):
    mpmath.mp.dps = 40
    E2 = sum(j * w * w for j, w in zip(J, start))
    M2 = sum((j * w)**2 for j, w in zip(J, start))
    if M2 <= E2 * J[1]:
        raise ArithmeticError("the closed form is that of more than the separatrix's angular momentum")
    a = sqrt((E2 * J[2] - M2) / (J[0] * (J[2] - J[0])))
    b = sqrt((E2 * J[2] - M2) / (J[1] * (J[2] - J[1])))
    c = sqrt((M2 - E2 * J[0]) / (J[2] * (J[2] - J[0])))
    speed = sqrt((J[2] - J[1]) * (M2 - E2 * J[0]) / (J[0] * J[1] * J[2]))
    m = (J[1] - J[0]) * (E2 * J[2] - M2) / ((J[2] - J[1]) * (M2 - E2 * J[0]))
    K = mpmath.ellipk(m)
    # The start has sn = start_2/b and cn > 0.
    phase = mpmath.ellipf(mpmath.asin(start[1] / b), m)

    def Omega(t):
        tau = phase + speed * t
        return [a * mpmath.ellipfun("cn", tau, m=m), b * mpmath.ellipfun("sn", tau, m=m),
                c * mpmath.ellipfun("dn", tau, m=m)]

    for value, given in zip(Omega(0), start):
        if abs(value - given) > mpf("1e-25"):
            raise ArithmeticError("the closed form does not begin at the start")
    # The closed form satisfies Euler's equations.
    w, rate = Omega(mpf(2)), [mpmath.diff(lambda t, k=k: Omega(t)[k], mpf(2)) for k in range(3)]
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        if abs(J[k] * rate[k] - (J[i] - J[j]) * w[i] * w[j]) > mpf("1e-15"):
            raise ArithmeticError("the closed form does not solve Euler's equations")
    for t in (10, 20):
        rows.add_vector(f"{t}.Omega", Omega(mpf(t)), 1e-11, f"angular velocity at {t} s [rad/s]")
    rows.add("first_flip", (2 * K - phase) / speed, 1e-12, "time when Omega_2 is zero first [s]")
    rows.add("between_flips", 2 * K / speed, 1e-13, "from one zero of Omega_2 to the next [s]")


if __name__ == "__main__":
    table.run(fill, __file__)
