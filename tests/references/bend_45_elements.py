"""The 45-degree bend of a few elements of constant strain, by the minimum of the energy.

An element of the length l between section frames A and B has the energy (d - d_0)^T C (d - d_0)/(2 l), with d =
log(A^-1 B), d_0 at rest, EA = 1e7, GA = 5e6, GJ = 5e6/6, EI = 1e7/12. At rest the nodes are on the arc of radius 100; a
dead load of 600 acts at the tip. Gradients use an imaginary step, and second derivatives are differences of gradients.
"""
import numpy as np

import table

C = np.array([1e7, 5e6, 5e6, 5e6 / 6, 1e7 / 12, 1e7 / 12])


def skew(v):
    z = 0 * v[..., 0]
    return np.stack([np.stack([z, -v[..., 2], v[..., 1]], -1), np.stack([v[..., 2], z, -v[..., 0]], -1),
                     np.stack([-v[..., 1], v[..., 0], z], -1)], -2)


def rotation(v):
    """Returns exp(skew(v)) by Rodrigues' formula with series, for angles well below pi."""
    x = (v * v).sum(-1)[..., None, None]
    sine = cosine = 0
    a = b = 1.0 + 0 * x
    b = b / 2
    for k in range(14):  # sin(t)/t and (1 - cos t)/t^2
        sine, cosine = sine + a, cosine + b
        a, b = -a * x / ((2 * k + 2) * (2 * k + 3)), -b * x / ((2 * k + 3) * (2 * k + 4))
    S = skew(v)
    return np.eye(3) + sine * S + cosine * (S @ S)


def logarithm(R, x):
    half = 0.5 * np.stack([R[..., 2, 1] - R[..., 1, 2], R[..., 0, 2] - R[..., 2, 0], R[..., 1, 0] - R[..., 0, 1]], -1)
    sine = np.sqrt((half * half).sum(-1))
    cosine = 0.5 * (np.trace(R, axis1=-2, axis2=-1) - 1)
    # Returns atan2 of complex numbers close to real ones: the angle and its change.
    angle = np.arctan2(sine.real, cosine.real) + 1j * (sine.imag * cosine.real - cosine.imag * sine.real)
    psi = (angle / sine)[..., None] * half
    P = skew(psi)
    t = angle / 2
    inverse = np.eye(3) - P / 2 + ((1 - t / np.tan(t)) / angle**2)[..., None, None] * (P @ P)
    return np.concatenate([(inverse @ x[..., None])[..., 0], psi], -1)


class Bend:
    def __init__(self, elements):
        self.n, self.length = elements, 25 * np.pi / elements
        a = np.pi / 4 * np.arange(elements + 1) / elements
        # The axes are along the arc, towards its centre, and across the plane.
        along, inwards = np.stack([np.sin(a), np.cos(a), 0 * a], -1), np.stack([np.cos(a), -np.sin(a), 0 * a], -1)
        self.R = np.stack([along, inwards, np.cross(along, inwards)], -1)
        self.x = np.stack([100 - 100 * np.cos(a), 100 * np.sin(a), 0 * a], -1)
        self.rest = np.concatenate([[self.length, 0, 0, 0, 0, self.length / 100]])

    def energies(self, u):
        """Returns the energy of each element, whose nodes have the increments u: six of A, six of B. More axes may
        precede them."""
        x_A, x_B = self.x[:-1] + u[..., :3], self.x[1:] + u[..., 6:9]
        A = np.swapaxes(self.R[:-1] @ rotation(u[..., 3:6]), -1, -2)
        d = logarithm(A @ self.R[1:] @ rotation(u[..., 9:]), (A @ (x_B - x_A)[..., None])[..., 0]) - self.rest
        return (C * d * d).sum(-1) / (2 * self.length)

    def gradients(self, u):
        """Returns the derivatives of the energy of each element by its twelve increments."""
        steps = 1e-30j * np.eye(12)[:, None, :]
        return np.moveaxis(self.energies(u[..., None, :, :] + steps).imag / 1e-30, -2, -1)

    def solve(self, load):
        """Moves the nodes to equilibrium under a slightly larger load."""
        for _ in range(200):
            rest, h = np.zeros((self.n, 12)), 1e-5
            g = self.gradients(rest)
            steps = h * np.eye(12)[:, None, :]
            H = (self.gradients(rest + steps) - self.gradients(rest - steps)) / (2 * h)  # [by, element, of]
            total, matrix = np.zeros(6 * self.n + 6), np.zeros((6 * self.n + 6, 6 * self.n + 6))
            for k in range(self.n):
                total[6 * k:6 * k + 12] += g[k]
                matrix[6 * k:6 * k + 12, 6 * k:6 * k + 12] += H[:, k]
            total[-4] -= load
            step = np.linalg.solve(0.5 * (matrix + matrix.T)[6:, 6:], -total[6:])
            largest = np.abs(step).max()
            step = step.reshape(-1, 6) * min(1, 2 / largest)  # rotations make the path of the step curved
            self.x[1:] += step[:, :3]
            self.R[1:] = self.R[1:] @ rotation(step[:, 3:])
            if largest < 1e-7:
                return
        raise ArithmeticError("no equilibrium is found")


def fill(rows):
    for elements in (1, 2, 4, 8):
        bend = Bend(elements)
        for load in np.linspace(0, 600, 13)[1:]:
            bend.solve(load)
        rows.add_vector(f"{elements}.tip", bend.x[-1], 1e-6, f"of {elements} elements")


if __name__ == "__main__":
    table.run(fill, __file__)
