"""Finite rotations: six parametrisations on arrays of NumPy, with their rates.

    from bielle import rotations

    R = rotations.to_matrix("bryant", [0.1, 0.2, 0.3])
    psi = rotations.from_matrix("rotation_vector", R)
    Omega = rotations.angular_velocity("rotation_vector", psi, rate)
    angles = rotations.continuous("euler", rotations.convert(run["nodes/pin/rotation"], "quaternion", "euler"))

R maps components in the rotating axes (material, body) to components in the fixed ones (spatial, inertial). With the
axis e and the angle phi of R, parameters p are

    "rotation_vector"  (..., 3)  phi e [rad]
    "quaternion"       (..., 4)  Euler parameters, the unit quaternion w x y z: cos(phi/2), sin(phi/2) e; of any length > 0
    "rodrigues"        (..., 3)  tan(phi/2) e
    "conformal"        (..., 3)  4 tan(phi/4) e (Wiener-Milenkovic)
    "euler"            (..., 3)  a, b, c [rad] about z x z: R = Rz(a) Rx(b) Rz(c)
    "bryant"           (..., 3)  a, b, c [rad] about x y z: R = Rx(a) Ry(b) Rz(c) (Cardan angles)

by the names that orientations have in model files. `SINGULARITIES` says where each of them fails, and what helps
there.

The tangent operator T gives the angular velocity by the rates of the parameters: Omega = T(p) pdot, where Omega is the
material one, dR/dt = R Omega~ with the skew matrix Omega~ (Omega~ b = Omega x b). frame="spatial" takes and gives
components in the fixed axes, omega = R Omega, with dR/dt = omega~ R; its time derivative is R Omegadot.

Leading dimensions are free: all functions take one item or arrays of them, and arguments are broadcast against each
other. Whatever NumPy makes numbers of is welcome; results are new arrays of double precision. Numbers that are not
finite, wrong shapes and matrices that are no rotations raise InputError; singular places raise ComputationError, which
names the item.

Source: A. Cardona, An Integrated Approach to Mechanism Analysis (thesis, Liege, 1989), ch. 1; M. Geradin, A. Cardona,
Flexible Multibody Dynamics (Wiley, 2001), ch. 4. These are the functions that the solvers use.
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, continuous_rotations

__all__ = ["PARAMETRISATIONS", "SINGULARITIES", "Singularity", "angular_acceleration", "angular_velocity", "complement",
           "compose", "continuous", "convert", "from_matrix", "nearest", "parameter_acceleration", "parameter_rate",
           "principal", "tangent", "tangent_derivative", "tangent_inverse", "tangent_inverse_derivative", "to_matrix"]

Numbers = NDArray[np.float64]
Frame = Literal["material", "spatial"]

PARAMETRISATIONS = ("rotation_vector", "quaternion", "rodrigues", "conformal", "euler", "bryant")
FRAMES = ("material", "spatial")
_CONTINUOUS = {"rotation_vector": continuous_rotations.continuous_vectors,
               "quaternion": continuous_rotations.continuous_quaternions,
               "euler": continuous_rotations.continuous_euler, "bryant": continuous_rotations.continuous_bryant}
_apply = _core.rotations


class Singularity(NamedTuple):
    """A place at which a parametrisation fails."""

    angle: str  # which one: "phi" of the rotation, or "b", the middle one of three
    values: tuple[float, ...]  # [rad] the first ones; empty: it never fails
    period: float  # [rad] they repeat with it
    fails: str  # the functions that have no value there
    remedy: str


SINGULARITIES: dict[str, Singularity] = {
    "rotation_vector": Singularity("phi", (2 * np.pi,), 2 * np.pi,
                                   "rates by the angular velocity, at full turns other than zero",
                                   "`principal` or `complement` (phi - 2 pi) from half a turn on"),
    "quaternion": Singularity("phi", (), 4 * np.pi, "nothing; its four numbers depend on each other", "none is needed"),
    "rodrigues": Singularity("phi", (np.pi,), 2 * np.pi, "the parameters, which are infinite at half turns",
                             "another parametrisation"),
    "conformal": Singularity("phi", (2 * np.pi,), 4 * np.pi, "the parameters, which are infinite at full turns",
                             "`principal` or `complement`, its shadow, from half a turn on"),
    "euler": Singularity("b", (0.0, np.pi), np.pi,
                         "a and c, of which a + c (b = 0) or a - c (b = pi) alone is determined, and rates",
                         "`bryant`, or `continuous` for rows"),
    "bryant": Singularity("b", (np.pi / 2, -np.pi / 2), np.pi,
                          "a and c, of which a + c (b = pi/2) or a - c (b = -pi/2) alone is determined, and rates",
                          "`euler`, or `continuous` for rows"),
}
"""Angles at which each parametrisation is singular, by its name."""


# -- to and from matrices

def to_matrix(parametrisation: str, p: ArrayLike) -> Numbers:
    """(..., 3, 3) rotation matrices R of parameters p. Any number of turns is welcome."""
    return _call(parametrisation, "rotation", p=p)


def from_matrix(parametrisation: str, R: ArrayLike) -> Numbers:
    """Principal parameters of rotation matrices R (..., 3, 3): `principal` says which those are.

    R may have rounding: where entries of R^T R - 1 are up to 1e-3, the parameters are those of the rotation nearest to
    R. At half turns the sign of the axis is arbitrary, and Rodrigues vectors raise ComputationError. At the
    singularity of three angles c = 0.
    """
    return _call(parametrisation, "parameters", R=R)


def convert(p: ArrayLike, parametrisation: str, to: str) -> Numbers:
    """The same rotations in the parametrisation `to`: principal parameters."""
    _check_name(to)
    return _apply(to, "parameters", [to_matrix(parametrisation, p)])


def principal(parametrisation: str, p: ArrayLike) -> Numbers:
    """Parameters of the same rotations in the principal domain.

    That is for the rotation vector phi <= pi, the quaternion length 1 and w >= 0, the conformal vector a length of up
    to 4 (phi <= pi), for Euler angles a, c in (-pi, pi] and b in [0, pi], for Bryant angles a, c in (-pi, pi] and b in
    [-pi/2, pi/2]. A Rodrigues vector is the only one of its rotation.
    """
    return _call(parametrisation, "principal", p=p)


def complement(parametrisation: str, p: ArrayLike) -> Numbers:
    """The other parameters of the same rotations, by which a motion goes on where it comes close to a singularity.

    Rotation vector: (phi - 2 pi) e. Quaternion: -p. Conformal vector: its shadow -16 p/|p|^2. Euler angles: (a +- pi,
    -b, c +- pi), Bryant angles: (a +- pi, pi - b, c +- pi), each half turn towards zero. Zero vectors have no
    complement, nor have Rodrigues vectors: ComputationError.
    """
    return _call(parametrisation, "complement", p=p)


def compose(parametrisation: str, first: ArrayLike, second: ArrayLike) -> Numbers:
    """Principal parameters of R(first) R(second): `second` is a rotation relative to axes that `first` has turned."""
    return _call(parametrisation, "compose", first=first, second=second)


# -- rows

def continuous(parametrisation: str, p: ArrayLike) -> Numbers:
    """Parameters of the same rotations that continue each other along the first dimension: rows over time.

    Angles count turns. Rotation vectors go through half a turn and beyond it. Euler or Bryant angles
    are the one of their two sets that is nearer to the row before, also through the singularity of the middle angle.
    Quaternions keep their sign. The first row is `principal`. Rows have to be less than half a turn apart.
    """
    _check_continuous(parametrisation)
    p = _numbers(parametrisation, "p", p)
    if p.ndim < 2:
        raise _core.InputError(f"expected rows of {_words(parametrisation)}, an array of the shape "
                               f"(rows, ..., {p.shape[-1]})")
    rows = _apply(parametrisation, "principal", [p])
    result = np.empty_like(rows)
    for item in np.ndindex(rows.shape[1:-1]):
        result[(slice(None), *item)] = _CONTINUOUS[parametrisation](rows[(slice(None), *item)])
    return result


def nearest(parametrisation: str, p: ArrayLike, reference: ArrayLike) -> Numbers:
    """Returns those parameters of the same rotations that continue `reference`, as in `continuous`."""
    _check_continuous(parametrisation)
    p, reference = _fitting(parametrisation, {"p": p, "reference": reference})
    rows = _apply(parametrisation, "principal", [p])
    result = np.empty_like(rows)
    for item in np.ndindex(rows.shape[:-1]):
        result[item] = _CONTINUOUS[parametrisation](np.stack([reference[item], rows[item]]), keep_first=True)[1]
    return result


# -- rates

def tangent(parametrisation: str, p: ArrayLike, *, frame: Frame = "material") -> Numbers:
    """T (..., 3, 3), of quaternions (..., 3, 4): the angular velocity is T pdot."""
    _check_frame(frame)
    p = _numbers(parametrisation, "p", p)
    T = _apply(parametrisation, "tangent", [p])
    return T if frame == "material" else _apply(parametrisation, "rotation", [p]) @ T


def tangent_inverse(parametrisation: str, p: ArrayLike, *, frame: Frame = "material") -> Numbers:
    """T^-1 (..., 3, 3), of quaternions (..., 4, 3), whose length stays: pdot = T^-1 Omega. ComputationError where T is
    singular.
    """
    _check_frame(frame)
    p = _numbers(parametrisation, "p", p)
    inverse = _apply(parametrisation, "tangent_inverse", [p])
    return inverse if frame == "material" else inverse @ _transposed(_apply(parametrisation, "rotation", [p]))


def tangent_derivative(parametrisation: str, p: ArrayLike, u: ArrayLike, *, frame: Frame = "material") -> Numbers:
    """Derivative of T along u, shaped as T: with u = pdot it is dT/dt."""
    _check_frame(frame)
    p, u = _fitting(parametrisation, {"p": p, "u": u})
    D = _apply(parametrisation, "tangent_derivative", [p, u])
    if frame == "material":
        return D
    # D(R T)[u] = R ((T u)~ T + DT[u])
    turn = _skew(_apply(parametrisation, "angular_velocity", [p, u]))
    return _apply(parametrisation, "rotation", [p]) @ (turn @ _apply(parametrisation, "tangent", [p]) + D)


def tangent_inverse_derivative(parametrisation: str, p: ArrayLike, u: ArrayLike, *,
                               frame: Frame = "material") -> Numbers:
    """Derivative of T^-1 along u, shaped as T^-1. ComputationError where T is singular."""
    _check_frame(frame)
    p, u = _fitting(parametrisation, {"p": p, "u": u})
    D = _apply(parametrisation, "tangent_inverse_derivative", [p, u])
    if frame == "material":
        return D
    # D(T^-1 R^T)[u] = (DT^-1[u] - T^-1 (T u)~) R^T
    turn = _skew(_apply(parametrisation, "angular_velocity", [p, u]))
    return (D - _apply(parametrisation, "tangent_inverse", [p]) @ turn) @ _transposed(
        _apply(parametrisation, "rotation", [p]))


def angular_velocity(parametrisation: str, p: ArrayLike, rate: ArrayLike, *, frame: Frame = "material") -> Numbers:
    """(..., 3) [rad/s] of parameters p that change by `rate` [1/s]."""
    _check_frame(frame)
    p, rate = _fitting(parametrisation, {"p": p, "rate": rate})
    return _in_frame(frame, parametrisation, p, _apply(parametrisation, "angular_velocity", [p, rate]))


def angular_acceleration(parametrisation: str, p: ArrayLike, rate: ArrayLike, acceleration: ArrayLike, *,
                         frame: Frame = "material") -> Numbers:
    """(..., 3) [rad/s^2] of parameters p with the first and second time derivatives `rate` [1/s] and `acceleration`
    [1/s^2].
    """
    _check_frame(frame)
    p, rate, acceleration = _fitting(parametrisation, {"p": p, "rate": rate, "acceleration": acceleration})
    found = _apply(parametrisation, "angular_acceleration", [p, rate, acceleration])
    return _in_frame(frame, parametrisation, p, found)


def parameter_rate(parametrisation: str, p: ArrayLike, velocity: ArrayLike, *, frame: Frame = "material") -> Numbers:
    """Time derivatives [1/s] of parameters p that turn with the angular velocity (..., 3) [rad/s].

    ComputationError where they are not determined: `SINGULARITIES`.
    """
    _check_frame(frame)
    p, velocity = _fitting(parametrisation, {"p": p, "velocity": velocity})
    return _apply(parametrisation, "parameter_rate", [p, _in_body(frame, parametrisation, p, velocity)])


def parameter_acceleration(parametrisation: str, p: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike, *,
                           frame: Frame = "material") -> Numbers:
    """Second time derivatives [1/s^2] of parameters p that turn with the angular velocity (..., 3) [rad/s] and
    acceleration (..., 3) [rad/s^2]. ComputationError where they are not determined."""
    _check_frame(frame)
    p, velocity, acceleration = _fitting(parametrisation, {"p": p, "velocity": velocity, "acceleration": acceleration})
    velocity, acceleration = (_in_body(frame, parametrisation, p, vectors) for vectors in (velocity, acceleration))
    return _apply(parametrisation, "parameter_acceleration", [p, velocity, acceleration])


# -- arguments

# Dimensions of an item of an argument, if they are not those of parameters.
_ITEMS = {"R": (3, 3), "velocity": (3,)}


def _call(parametrisation: str, function: str, **arguments: ArrayLike) -> Numbers:
    return _apply(parametrisation, function, _fitting(parametrisation, arguments))


def _fitting(parametrisation: str, arguments: dict[str, ArrayLike]) -> list[Numbers]:
    """Arrays of the same leading dimensions."""
    _check_name(parametrisation)
    of_motion = "velocity" in arguments  # an acceleration is then angular
    arrays = {name: _numbers(parametrisation, name, value, of_motion) for name, value in arguments.items()}
    if len(arrays) == 1:
        return list(arrays.values())
    inner = {name: 2 if name == "R" else 1 for name in arrays}
    leading = {name: array.shape[:array.ndim - inner[name]] for name, array in arrays.items()}
    try:
        common = np.broadcast_shapes(*leading.values())
    except ValueError:
        shapes = " and ".join(f"{array.shape} of `{name}`" for name, array in arrays.items())
        raise _core.InputError(f"the shapes {shapes} do not fit together: all dimensions but those of an item have to "
                               "be alike, or 1") from None
    return [np.ascontiguousarray(np.broadcast_to(array, common + array.shape[len(leading[name]):]))
            for name, array in arrays.items()]


def _numbers(parametrisation: str, name: str, value: Any, of_motion: bool = False) -> Numbers:
    """An array of finite numbers whose last dimensions are those of an item. Raises InputError."""
    _check_name(parametrisation)
    item = _ITEMS.get(name, (4,) if parametrisation == "quaternion" else (3,))
    if of_motion and name == "acceleration":
        item = (3,)
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiub" and array.size or array.dtype.kind == "c":
            raise TypeError
        array = np.ascontiguousarray(array, dtype=float)
    except (TypeError, ValueError):
        raise _core.InputError(f"`{name}`: expected an array of real numbers") from None
    expected = f"the shape (..., {', '.join(map(str, item))})"
    what = {"R": "rotation matrices have ", "p": f"{_words(parametrisation)} have "}.get(name, "expected ")
    if array.shape[-len(item):] != item or np.ndim(value) < len(item):
        raise _core.InputError(f"`{name}`: {what}{expected}, found {np.shape(value)}")
    bad = ~np.isfinite(array)
    if bad.any():
        place = tuple(int(k) for k in np.argwhere(bad)[0])
        raise _core.InputError(f"`{name}`: the number at {list(place)} is {array[place]}: finite numbers are expected")
    return array


def _words(parametrisation: str) -> str:
    return {"rotation_vector": "rotation vectors", "quaternion": "quaternions w x y z",
            "rodrigues": "Rodrigues vectors", "conformal": "conformal rotation vectors", "euler": "Euler angles",
            "bryant": "Bryant angles"}[parametrisation]


def _check_name(parametrisation: str) -> None:
    if parametrisation not in PARAMETRISATIONS:
        hint = _core.did_you_mean(parametrisation, list(PARAMETRISATIONS)) if isinstance(parametrisation, str) else ""
        raise _core.InputError(f"{parametrisation!r} is no parametrisation of rotations{hint} "
                               f"(there are: {', '.join(PARAMETRISATIONS)})")


def _check_continuous(parametrisation: str) -> None:
    _check_name(parametrisation)
    if parametrisation not in _CONTINUOUS:
        raise _core.InputError(f"{_words(parametrisation)} cannot be continued over turns, as they are infinite at "
                               f"some angle: take one of {', '.join(_CONTINUOUS)}")


def _check_frame(frame: str) -> None:
    if frame not in FRAMES:
        hint = _core.did_you_mean(frame, list(FRAMES)) if isinstance(frame, str) else ""
        raise _core.InputError(f"{frame!r} is no frame{hint}: components are \"material\", in the rotating axes, or "
                               "\"spatial\", in the fixed ones")


# -- frames

def _in_frame(frame: str, parametrisation: str, p: Numbers, vectors: Numbers) -> Numbers:
    """From material components."""
    if frame == "material":
        return vectors
    return np.einsum("...ij,...j->...i", _apply(parametrisation, "rotation", [p]), vectors)


def _in_body(frame: str, parametrisation: str, p: Numbers, vectors: Numbers) -> Numbers:
    """To material components."""
    if frame == "material":
        return vectors
    return np.einsum("...ji,...j->...i", _apply(parametrisation, "rotation", [p]), vectors)


def _transposed(matrices: Numbers) -> Numbers:
    return np.swapaxes(matrices, -1, -2)


def _skew(vectors: Numbers) -> Numbers:
    x, y, z = np.moveaxis(vectors, -1, 0)
    zero = np.zeros_like(x)
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*x.shape, 3, 3)
