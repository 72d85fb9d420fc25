"""The frame that snaps through: both limit loads against the solution of the rod's differential equations."""

from bielle_tools.gallery.machine import Check, Machine, Picture, Rows

LIMITS = 1854.4527094, -939.2489640  # [N] Reissner's rod by shooting with continuation (tests/references)


def check(paths):
    load = Rows(paths["frame"]).time  # a static analysis records the load factor as time, here in newtons
    found = load[: len(load) // 2].max(), load.min()
    return [Check(f"{which} limit load", "N", value, limit, 2e-4, "40 elements", "Reissner's rod by shooting")
            for which, value, limit in zip(("upper", "lower"), found, LIMITS)]


MACHINE = Machine(
    title="Frame that snaps through",
    teaches="A path of equilibria goes past limit points by arc length, through states that need an upward load. "
            "Load steps alone would end at the first limit load, and a real frame jumps there.",
    runs={"frame": ["snap_through.yaml"]},
    pictures=[Picture("frame", ["--view=z", "--frames", "6"])],
    page="frame",
    check=check)
