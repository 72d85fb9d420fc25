"""Bielle: flexible mechanisms by finite elements, driven from Python.

A model is the same as in a file of bielle-mechanism: a YAML file, a text, or a dictionary with the same names and keys.

    import bielle

    model = bielle.load("engine.yaml", parameters={"speed": 50})
    session = model.session()
    session.statics(steps=5)
    for motion in session.dynamics(duration=2, step=1e-3):
        session.inputs["torque"] = controller(session.measure("arm.angle"), motion.time)
    session["joints/main/coordinate"]                  # of now

    run = bielle.run("engine.yaml")                    # all analyses of the file; results in memory, no files
    run.time, run["nodes/pin/position"]                # arrays of NumPy, row by row

    arm = bielle.Model("arm", gravity=[0, 0, -9.81])    # or put together by calls, with the keys as arguments
    arm.node("elbow", position=[1, 0, 0])
    arm.rigid_body("elbow", node="elbow", mass=2, inertia=[1, 1, 1])
    arm.hinge("shoulder", nodes=["ground", "elbow"], position=[0, 0, 0], axis=[0, 1, 0])

`load` and `read` make a `Model`, `Model.session` a `Session`, `Session.dynamics` a `Motion`; `run` gives a `Run` of
`Results`. Units are SI and radians. A request that cannot be satisfied raises `InputError` or
`ComputationError`, with the messages of the programs. mechanism/README.md describes the model, mechanism/io/README.md the names of results.
`superelement` makes a superelement of matrices, `explain` explains a message. `bielle.rotations` has the parametrisations of rotations, with their rates.
"""

from . import rotations
from ._core import ComputationError, Error, InputError, Node, State, explain
from ._core import commit as __commit__
from ._core import version as __version__
from .models import Model, load, read
from .motions import Motion
from .results import Dataset, Event, Results
from .runs import Run, run
from .sessions import Inputs, Recording, Session
from .superelements import superelement
from .views import View, view

__all__ = ["ComputationError", "Dataset", "Error", "Event", "InputError", "Inputs", "Model", "Motion", "Node", "Recording",
           "Results", "Run", "Session", "State", "View", "explain", "load", "read", "rotations", "run", "superelement",
           "view", "__commit__", "__version__"]

for _each in (Node, State):
    _each.__module__ = "bielle"
del _each
