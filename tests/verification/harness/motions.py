"""Runs of models that many problems need."""

import bielle
import numpy as np


def moved(text, duration, step, look=None, **keys):
    """The session of a model at the end of a motion. @param text model file or dictionary @param look called with the
    session at the start and after each step @param keys those of the analysis `dynamic`"""
    session = bielle.read(text).session()
    motion = session.dynamics(duration=duration, step=step, **keys)
    if look is None:
        motion.finish()
        return session
    look(session)
    for _ in motion:
        look(session)
    return session


class EnergyDrift:
    """The largest deviation of kinetic, elastic and potential energy from that of the start [J]; a `look` of
    `moved`."""

    def __init__(self):
        self.first, self.largest = None, 0.0

    def __call__(self, session):
        energy = session.energy
        total = energy["kinetic"] + energy["elastic"] + energy["gravity"]
        self.first = total if self.first is None else self.first
        self.largest = max(self.largest, abs(total - self.first))


def axes(session, node):
    """The rotation matrix of a node, whose columns are its axes in the inertial frame."""
    return np.array(session.node(node).axes)
