"""A cylinder and a mass of 500 kg: m v' = A_1 p_1 - A_2 p_2 - c v - F, V_k p_k' = B (Q_k -+ A_k v), by DOP853.

B = 1.4e9 Pa, rho = 850 kg/m^3, C_d = 0.62; orifices are laminar below D_t: Q = C_d A sqrt(2/rho) D/(D^2 + D_t^2)^(1/4).
Edges of the servo-valve open by x (6 u - 8 u^2 + 3 u^3) u, u = x/1e-3, in their first thousandth.
"""
import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

import motion
import table

m, g, B, rho, C_d = 500, 9.81, 1.4e9, 850, 0.62
A_1, A_2 = 2e-3, 1.2e-3


def flow(area, D, D_t):
    return C_d * area * np.sqrt(2 / rho) * D / (D * D + D_t * D_t)**0.25


def edge(x):
    u = min(max(x, 0) / 1e-3, 1)
    return x if u == 1 else 1e-3 * u**3 * (6 - 8 * u + 3 * u * u)


def lifted(rows):
    """A single-acting cylinder against the weight, from rest in balance, with a supply of 10 MPa through a hole of 2
    mm. States are x, v, p/1e6."""
    def rate(_, z):
        x, v, p = z[0], z[1], 1e6 * z[2]
        Q = flow(np.pi / 4 * 0.002**2, 10e6 - p, 10)
        return [v, (A_1 * p - 2000 * v - m * g) / m, B * (Q - A_1 * v) / (1e-3 + A_1 * x) / 1e6]
    for time, (x, v, p) in zip((0.1, 2), motion.integrate(rate, [0, 0, m * g / A_1 / 1e6], [0.1, 2], agree=1e-9)):
        rows.add(f"lifted_{time}.length", 1 + x, 1e-10, f"at {time} s [m]")
        rows.add(f"lifted_{time}.rate", v, 1e-9, f"at {time} s [m/s]")
        rows.add(f"lifted_{time}.pressure", 1e6 * p, 1e-2, f"at {time} s [Pa]")


def double_acting(command, tank, D_t):
    """A double-acting cylinder, from rest with 6 and 10 MPa. States are x, v, p_1/1e6, p_2/1e6."""
    def rate(t, z):
        x, v, p_1, p_2 = z[0], z[1], 1e6 * z[2], 1e6 * z[3]
        area = 5e-6 * edge(command(t))
        leak = 1e-12 * (p_1 - p_2)
        Q_1, Q_2 = flow(area, 21e6 - p_1, D_t) - leak, leak - flow(area, p_2 - tank, D_t)
        return [v, (A_1 * p_1 - A_2 * p_2 - 1500 * v) / m, B * (Q_1 - A_1 * v) / (1e-3 + A_1 * x) / 1e6,
                B * (Q_2 + A_2 * v) / (0.8e-3 - A_2 * x) / 1e6]
    return rate


def add(rows, name, z, within=1.0):
    rows.add(f"{name}.length", 1 + z[0], within * 1e-10, "[m]")
    rows.add(f"{name}.rate", z[1], within * 1e-9, "[m/s]")
    for k in (1, 2):
        rows.add(f"{name}.pressure_{k}", 1e6 * z[1 + k], within * 1e-2, "[Pa]")


def opened(rows):
    """The valve opens within 10 ms. The integration restarts at the kinks of the command."""
    begin = [0, 0, 6, 10]
    pieces = [(0, 1e-5, lambda t: t / 0.01), (1e-5, 0.01, lambda t: t / 0.01), (0.01, 1, lambda t: 1.0)]
    z = np.array(begin, float)
    for a, b, command in pieces:
        rate = double_acting(command, 0.1e6, 10)
        times = [0.09, 0.99] if b == 1 else [b - a]
        states = motion.integrate(lambda t, z, rate=rate, a=a: rate(a + t, z), z, times)
        z = states[-1]
    add(rows, "opened_0.1", states[0])
    add(rows, "opened_1", states[1])


def smooth(t, a, b):
    x = min(max((t - a) / (b - a), 0), 1)
    return x * x * x * (10 - x * (15 - 6 * x))


def stopped(rows):
    """The valve opens within 10 ms and closes from 0.2 to 0.26 s."""
    rate = double_acting(lambda t: smooth(t, 0, 0.01) - smooth(t, 0.2, 0.26), 5e6, 1e4)
    z, a, peaks = np.array([0, 0, 6, 10], float), 0, []
    for b in (0.01, 0.2, 0.26, 0.3):
        solution = solve_ivp(rate, (a, b), z, method="DOP853", rtol=1e-13, atol=1e-13, max_step=2e-4, dense_output=True)
        times = np.linspace(a, b, 20001)
        pressures = solution.sol(times)[3]
        k = pressures.argmax()
        if a >= 0.2 and 0 < k < len(times) - 1:
            # The rate of the pressure is zero at the peak.
            top = brentq(lambda t: rate(t, solution.sol(t))[3], times[k - 1], times[k + 1], xtol=1e-14)
            peaks.append(solution.sol(top)[3])
        z, a = solution.y[:, -1], b
    rows.add("stopped.peak", 1e6 * max(peaks), 1, "largest pressure of chamber 2 from 0.2 s on [Pa]")
    add(rows, "stopped_0.3", z, 10)


def blocked(rows):
    """Both chambers are closed, and the mass starts with 0.1 m/s. The potential of the oil gives the turning points,
    and quadrature the period."""
    V_1, V_2 = 1e-3, 0.8e-3

    def force(x):
        return A_1 * (6e6 - B * np.log1p(A_1 * x / V_1)) - A_2 * (10e6 - B * np.log1p(-A_2 * x / V_2))

    def speed2(x):
        return 0.01 + 2 / m * quad(force, 0, x, epsabs=1e-16, epsrel=1e-13)[0]
    top, bottom = brentq(speed2, 1e-5, 1e-2, xtol=1e-17), brentq(speed2, -1e-2, -1e-5, xtol=1e-17)
    middle, half = 0.5 * (top + bottom), 0.5 * (top - bottom)
    # With x = middle + half sin(a) the integrand is smooth up to the turning points, which are omitted because of
    # rounding.
    a = (np.arange(400) + 0.5) / 400 * np.pi - np.pi / 2
    period = 2 * np.pi / 400 * sum(half * np.cos(k) / np.sqrt(speed2(middle + half * np.sin(k))) for k in a)
    rows.add("blocked.period", period, 1e-10, "[s]")
    rows.add("blocked.highest", top, 1e-13, "from the start [m]")
    rows.add("blocked.lowest", bottom, 1e-13, "from the start [m]")


def fill(rows):
    lifted(rows)
    opened(rows)
    stopped(rows)
    blocked(rows)


if __name__ == "__main__":
    table.run(fill, __file__)
