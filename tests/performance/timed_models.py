"""The models that `race` and `budget` run: small ones in many steps, and the first step of each."""

import os
import subprocess

import yaml

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
EVERY = 100  # steps between rows


def finished(parts, steps, size, layout=None):
    layout = f", layout: {layout}" if layout else ""
    return "\n".join([*parts, f"analysis: [{{type: dynamic, duration: {steps * size:.9g}, step: {size:g}}}]",
                      f"output: {{every: {EVERY}{layout}}}"]) + "\n"


def chain(links, joint, steps, layout=None):
    """Returns rigid links of 1 m and 1 kg, released from the horizontal."""
    parts = ["gravity: [0, 0, -9.81]", "nodes:"]
    parts += [f"  b{k}: {{position: [{k + 0.5}, 0, 0]}}" for k in range(links)]
    parts += ["elements:"]
    parts += [f"  m{k}: {{type: rigid_body, node: b{k}, mass: 1, inertia: [0.001, 0.0833, 0.0833]}}" for k in range(links)]
    parts += ["joints:"]
    axis = ", axis: [0, 1, 0]" if joint == "hinge" else ""
    parts += [f"  j{k}: {{type: {joint}, nodes: [{f'b{k - 1}' if k else 'ground'}, b{k}], position: [{k}, 0, 0]{axis}}}"
              for k in range(links)]
    return finished(parts, steps, 1e-3, layout)


def slider_crank(steps):
    """Rigid crank, rod and piston, which a torque drives."""
    return finished(["""gravity: [0, 0, -9.81]
nodes: {crank: {position: [0.1, 0, 0]}, rod: {position: [0.5, 0, 0]}, piston: {position: [0.8, 0, 0]}}
elements:
  crank: {type: rigid_body, node: crank, mass: 1, inertia: [0.001, 0.004, 0.004]}
  rod: {type: rigid_body, node: rod, mass: 2, inertia: [0.001, 0.06, 0.06]}
  piston: {type: rigid_body, node: piston, mass: 1, inertia: [0.001, 0.001, 0.001]}
joints:
  main: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 1, 0], start_rate: 20}
  pin: {type: spherical, nodes: [crank, rod], position: [0.2, 0, 0]}
  wrist: {type: universal, nodes: [rod, piston], position: [0.8, 0, 0], axis: [0, 1, 0], second_axis: [0, 0, 1]}
  bore: {type: prismatic, nodes: [ground, piston], position: [0.8, 0, 0], axis: [1, 0, 0]}
drives: {motor: {joint: main, torque: "2*sin(30*t)"}}"""], steps, 1e-4)


def spin_up(steps):
    """The arm of Simo and Vu-Quoc, which is spun up (tests/benchmarks/beams/test_spin_up.cpp), with ten elements."""
    return finished(["""nodes: {hub: {}, tip: {position: [10, 0, 0]}}
elements:
  arm: {type: beam, nodes: [hub, tip], elements: 10,
        section: {EA: 2.8e7, GAy: 1e7, GAz: 1e7, GJ: 1.4e4, EIy: 1.4e4, EIz: 1.4e4, mass_per_length: 1.2, Jx: 1.2e-3, Jy: 6e-4, Jz: 6e-4}}
joints: {pivot: {type: hinge, nodes: [ground, hub], axis: [0, 0, 1]}}
drives: {motor: {joint: pivot, angle: "if(t < 15, 0.4*(t^2/2 + (15/(2*pi))^2*(cos(2*pi*t/15) - 1)), 6*t - 45)"}}"""],
                    steps, 5e-3)


def superelement(file, steps):
    """A pendulum that is the reduction of a solid mesh with 30 modes."""
    return finished([f"""gravity: [0, 0, -9.81]
nodes: {{a: {{}}, b: {{position: [1, 0, 0]}}}}
elements: {{bar: {{type: superelement, file: {file}, nodes: {{root: a, tip: b}}}}}}
joints: {{pivot: {{type: hinge, nodes: [ground, a], axis: [0, 1, 0]}}}}"""], steps, 1e-4)


def reduced_bar(folder, programs):
    """Reduces the bar of `meshes/` to 30 modes. @param programs  folder of bielle-reduce  @returns the superelement's path"""
    with open(os.path.join(ROOT, "meshes", "bar.yaml"), encoding="utf-8") as file:
        body = file.read().replace("bar.geo", os.path.join(ROOT, "meshes", "bar.geo"))
    lines = ["modes: {count: 30}" if line.startswith("modes:") else line for line in body.splitlines()]
    with open(os.path.join(folder, "bar.yaml"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    bar = os.path.join(folder, "bar.h5")
    subprocess.run([os.path.join(programs, "bielle-reduce"), os.path.join(folder, "bar.yaml"), "-o", bar, "--quiet"], check=True)
    return bar


def makers(bar):
    """@param bar  path of the superelement  @returns {name: (function that makes the model of so many steps, steps)}"""
    return {"slider-crank": (slider_crank, 10_000),
            "superelement, 30 modes": (lambda steps: superelement(bar, steps), 5000),
            "spin-up, 10 beams": (spin_up, 4000),
            "100 spherical": (lambda steps: chain(100, "spherical", steps), 2000),
            "100 spherical, stacked": (lambda steps: chain(100, "spherical", steps, "stacked"), 2000),
            "100 hinges": (lambda steps: chain(100, "hinge", steps), 2000),
            "100 hinges, stacked": (lambda steps: chain(100, "hinge", steps, "stacked"), 2000),
            "500 spherical": (lambda steps: chain(500, "spherical", steps), 2000)}


def step_size(text):
    """@returns the step of a model [s]"""
    return yaml.safe_load(text)["analysis"][0]["step"]


def write_models(folder, programs, shorter=1):
    """Writes all models into a folder. @param programs  folder of bielle-reduce  @param shorter  divides the steps
    @returns the paths by name"""
    bar = reduced_bar(folder, programs)
    models = {}
    for name, (make, steps) in makers(bar).items():
        for title, count in ((f"{name}: one step", 1), (f"{name}: {max(steps // shorter, 2)} steps", max(steps // shorter, 2))):
            models[title] = os.path.join(folder, f"model{len(models)}.yaml")
            with open(models[title], "w", encoding="utf-8") as file:
                file.write(make(count))
    return models
