"""Motions by DOP853 with two tolerances, whose results must agree."""
import numpy as np
from scipy.integrate import solve_ivp


def integrate(rate, start, times, agree=1e-9, rtol=2.3e-14, atol=1e-14, max_step=np.inf):
    """Returns states at ascending times after zero, one row each. @param rate  dz/dt of (t, z)

    The motion is computed with rtol and with thirty times as much. Their difference, relative to the largest value of
    each component, has to be less than `agree`.
    """
    def motion(factor):
        solution = solve_ivp(rate, (0, times[-1]), start, method="DOP853", rtol=factor * rtol, atol=factor * atol,
                             t_eval=times, max_step=max_step)
        if not solution.success:
            raise ArithmeticError(solution.message)
        return solution.y.T

    fine, coarse = motion(1), motion(30)
    size = np.maximum(np.abs(fine).max(axis=0), np.finfo(float).tiny)
    apart = (np.abs(fine - coarse) / size).max()
    if apart > agree:
        raise ArithmeticError(f"two tolerances differ by {apart:g}, more than {agree:g}")
    return fine


def cross_matrix(v):
    """w -> v x w."""
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(q):
    """Returns the matrix of a quaternion (scalar first) of any length."""
    s, v = q[0], np.asarray(q[1:])
    n = q @ q
    return ((s * s - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * s * cross_matrix(v)) / n


def quaternion_rate(q, Omega):
    """Returns dq/dt of a quaternion from the angular velocity in the body's axes."""
    s, v = q[0], q[1:]
    return 0.5 * np.concatenate([[-v @ Omega], s * Omega + np.cross(v, Omega)])
