"""Compares controllers in Python, which set inputs at each step, with formulas and controllers of the model itself."""

import unittest

import numpy as np

import bielle
from samples import WHEEL

DURATION, OMEGA = 1.0, 5.0
INERTIA = 2.0  # inertia of the wheel about its axle


def torque(time):
    return np.sin(OMEGA * time)


def turned(time):
    """Returns the angle of the wheel under this torque, from rest."""
    return (time / OMEGA - np.sin(OMEGA * time) / OMEGA**2) / INERTIA


def driven(steps, when, smooth):
    """Returns the angle at the end. Before each step the torque is set to its value at a fraction `when` of that
    step."""
    session = bielle.read(WHEEL).session()
    size = DURATION / steps
    motion = session.dynamics(DURATION, size)
    for k in range(steps):
        session.set_input("torque", torque((k + when) * size), smooth=smooth)
        motion.step()
    assert motion.done
    return session.measure("axle.angle")


def by_formula(steps):
    model = WHEEL.replace("torque: torque", f'torque: "sin({OMEGA}*t)"').replace("inputs: {torque: {start: 0, units: N m}}\n", "")
    session = bielle.read(model).session()
    session.dynamics(DURATION, DURATION / steps).finish()
    return session.measure("axle.angle")


class Inputs(unittest.TestCase):
    def orders(self, error):
        """Returns the orders of convergence from halved steps."""
        errors = [abs(error(steps)) for steps in (100, 200, 400)]
        return np.log2(np.array(errors[:-1]) / errors[1:])

    def test_a_formula_of_time_is_of_second_order(self):
        np.testing.assert_allclose(self.orders(lambda steps: by_formula(steps) - turned(DURATION)), 2, atol=0.1)

    def test_the_value_of_the_end_of_the_step_is_the_formula(self):
        """The value is smooth and taken at the time of the step's equations, so that the motion is the same up to
        Newton's tolerance (1e-9 of the forces)."""
        for steps in (50, 200):
            self.assertAlmostEqual(driven(steps, 1, True), by_formula(steps), delta=1e-9)

    def test_the_value_of_the_beginning_is_of_first_order(self):
        """A controller that reads the state reads the beginning of the step, which is half a step late on average."""
        for smooth in (True, False):
            np.testing.assert_allclose(self.orders(lambda steps: driven(steps, 0, smooth) - turned(DURATION)), 1, atol=0.1)

    def test_the_value_of_the_middle_held_is_of_second_order(self):
        np.testing.assert_allclose(self.orders(lambda steps: driven(steps, 0.5, False) - turned(DURATION)), 2, atol=0.1)

    def test_a_jump_acts_from_where_it_is_set(self):
        session = bielle.read(WHEEL).session()
        motion = session.dynamics(1, 0.01)
        motion.advance_to(0.5)
        session.inputs["torque"] = 4
        motion.finish()
        # Constant accelerations are exact: 2 rad/s^2 over half a second.
        self.assertAlmostEqual(session.measure("axle.angle"), 0.25, places=10)
        self.assertAlmostEqual(session.measure("axle.angle.rate"), 1, places=10)

    def test_inputs_in_statics(self):
        model = WHEEL.replace(
            "axis: [0, 0, 1]}", "axis: [0, 0, 1], stiffness: 10}")
        session = bielle.read(model).session()
        for value in (1, -2, 3.5):
            session.inputs["torque"] = value
            session.statics(record=False)
            self.assertAlmostEqual(session.measure("axle.angle"), value / 10, places=9)


ARM = """\
gravity: [0, 0, -9.81]
nodes: {arm: {position: [0.4, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 4, inertia: [0.01, 0.2, 0.2]}}
joints: {shoulder: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, -1, 0]}}
"""
KP, KI, KD, LIMIT, TARGET = 600.0, 1500.0, 60.0, 1000.0, 0.3


class Pid(unittest.TestCase):
    """The controller of the model is a part of the equations; the one in Python samples and holds at the beginning of
    each step."""

    def in_the_model(self, step):
        model = ARM + (f"drives: {{motor: {{joint: shoulder, pid: {{target: {TARGET}, kp: {KP}, ki: {KI}, kd: {KD}, "
                       f"limit: {LIMIT}}}}}}}\n")
        session = bielle.read(model).session()
        with session.record() as recording:
            session.dynamics(1, step).finish()
        return recording[0]["joints/shoulder/coordinate"][:, 0]

    def in_python(self, step):
        session = bielle.read(ARM + "inputs: {torque: 0}\ndrives: {motor: {joint: shoulder, torque: torque}}\n").session()
        motion, integral, angles = session.dynamics(1, step), 0.0, [0.0]
        while not motion.done:
            error, rate = TARGET - session.measure("shoulder.angle"), session.measure("shoulder.angle.rate")
            session.inputs["torque"] = np.clip(KP * error + KI * integral - KD * rate, -LIMIT, LIMIT)
            integral += error * step
            motion.step()
            angles.append(session.measure("shoulder.angle"))
        return np.array(angles)

    def test_a_sampled_controller_tends_to_the_continuous_one(self):
        """Sampling delays the torque by half a step on average, so that the difference is of first order in the
        step."""
        steps = (4e-3, 2e-3, 1e-3, 5e-4)
        differences = [np.abs(self.in_python(step) - self.in_the_model(step)).max() for step in steps]
        orders = np.log2(np.array(differences[:-1]) / differences[1:])
        np.testing.assert_allclose(orders, 1, atol=0.2)
        self.assertLess(differences[-1], 0.01 * TARGET)
        self.assertAlmostEqual(self.in_python(1e-3)[-1], self.in_the_model(1e-3)[-1], delta=1e-3 * TARGET)


if __name__ == "__main__":
    unittest.main()
