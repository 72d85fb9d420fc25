#!/usr/bin/python3
"""A controller in Python: a PID with a limited torque lifts an arm, sampled every 2 ms.

    PYTHONPATH=build/release/python mechanism/python/examples/controller.py
"""

import bielle

PERIOD = 2e-3  # [s] of the controller, and the step of the motion
ARM = {
    "mechanism": "an arm that Python lifts",
    "gravity": [0, 0, -9.81],
    "nodes": {"arm": {"position": [0.4, 0, 0]}},
    "elements": {"arm": {"type": "rigid_body", "node": "arm", "solid": {"box": [0.8, 0.06, 0.04], "mass": 4}}},
    "joints": {"shoulder": {"type": "hinge", "nodes": ["ground", "arm"], "position": [0, 0, 0], "axis": [0, -1, 0]}},
    "inputs": {"torque": {"start": 0, "units": "N m"}},
    "drives": {"motor": {"joint": "shoulder", "torque": "torque"}},
}


class Pid:
    """kp e + ki z + kd e', within a limit; z is constant while the limit is reached (anti-windup)."""

    def __init__(self, kp, ki, kd, limit, period):
        self.kp, self.ki, self.kd, self.limit, self.period = kp, ki, kd, limit, period
        self.integral = 0.0

    def torque(self, error, rate):
        wanted = self.kp * error + self.ki * self.integral + self.kd * rate
        possible = min(max(wanted, -self.limit), self.limit)
        if possible == wanted:
            self.integral += error * self.period
        return possible


def lift(target=0.8, duration=2.0):
    """Angles [rad] and torques [N m] over time [s]."""
    session = bielle.read(ARM).session()
    pid = Pid(kp=600, ki=1500, kd=60, limit=28, period=PERIOD)
    with session.record() as recording:
        motion = session.dynamics(duration, PERIOD)
        while not motion.done:
            error = target - session.measure("shoulder.angle")
            session.inputs["torque"] = pid.torque(error, -session.measure("shoulder.angle.rate"))
            motion.step()
    results = recording[0]
    return results.time, results["joints/shoulder/coordinate"][:, 0], results["joints/shoulder/drive_force"][:, 0]


if __name__ == "__main__":
    time, angle, torque = lift()
    print(f"after {time[-1]:.1f} s the arm stands at {angle[-1]:.4f} rad; it went up to {angle.max():.4f} rad, "
          f"with at most {abs(torque).max():.1f} N m")
