"""The models of `timed_models.py` as input files of MBDyn 1.7 (MBDyn Input Manual), for `race --mbdyn` and `accuracy`.

The models have the same masses, joints, start velocities, drives and steps. MBDyn's beams are `beam2` with lumped masses, and its
deformable body is a modal joint with all modes of the free reduced bar; both differ from Bielle's by the discretisation.
"""

import itertools
import os
import subprocess

from other_programs import ROOT, Run

SOLVERS = ("naive, colamd", "klu", "umfpack")
NEWTON = ("newton raphson", "newton raphson, modified, 5", "newton raphson, modified, 10",
          "newton raphson, modified, 20, keep jacobian matrix")
COMPARED_NODES = {"slider-crank": "piston", "superelement, 30 modes": "b", "spin-up, 10 beams": "tip", "100 spherical": "b99",
                  "100 hinges": "b99", "500 spherical": "b499"}
SETTINGS = tuple(itertools.product(SOLVERS, NEWTON))
ABOUT_Y = "1, 1.,0.,0., 3, 0.,1.,0."  # orientation with y as its third axis


class Model:
    """Returns the entries of an input file by their keyword."""

    def __init__(self):
        self.nodes, self.elements, self.counts = [], [], {}
        self.has_gravity = True
        # Tolerance of the first accelerations, without which the first step has an error of first order.
        self.start_tolerance = 1e-4

    def node(self, position, kind="dynamic", velocity="null", rate="null"):
        self.nodes.append(f"structural: {len(self.nodes) + 1}, {kind}, {position}, eye, {velocity}, {rate};")
        return len(self.nodes)

    def element(self, keyword, count, text):
        number = self.counts[count] = self.counts.get(count, 0) + 1
        self.elements.append(f"{keyword}: {number}, {text};")
        return number

    def body(self, node, mass, inertia):
        self.element("body", "rigid bodies", f"{node}, {mass}, null, diag, {inertia}")

    def joint(self, text):
        return self.element("joint", "joints", text)

    def text(self, steps, size, setting, every):
        """@param every  steps between rows of output; 0: no output"""
        solver, newton = setting
        output = "default output: none;"
        if every:
            output = f"output precision: 16; output meter: meter, 0., forever, steps, {every};"
        counts = [f"{name}: {count};" for name, count in self.counts.items()]
        gravity = []
        if self.has_gravity:
            counts.append("gravity;")
            gravity.append("gravity: uniform, 0.,0.,-1., 9.81;")
        return "\n".join(["begin: data; problem: initial value; end: data;", "begin: initial value;", "initial time: 0.;",
                          f"final time: {(steps - 0.5) * size:.12g};", f"time step: {size:.12g};", "method: ms, 0.6;",
                          "tolerance: 1e-6;", "max iterations: 100;", f"derivatives tolerance: {self.start_tolerance};",
                          "derivatives max iterations: 50;", "derivatives coefficient: 1e-4;",
                          f"linear solver: {solver};", f"nonlinear solver: {newton};", "end: initial value;",
                          "begin: control data;", f"structural nodes: {len(self.nodes)};", *counts, "skip initial joint assembly;",
                          output, "end: control data;", "begin: nodes;", *self.nodes, "end: nodes;", "begin: elements;",
                          *self.elements, *gravity, "end: elements;"]) + "\n"


def chain(links, joint):
    model = Model()
    for k in range(links):
        node = model.node(f"{k + 0.5}, 0., 0.")
        model.body(node, 1, "0.001, 0.0833, 0.0833")
        hinge = f", hinge, {ABOUT_Y}" if joint == "revolute" else ""
        if k == 0:
            model.joint(f"{joint} pin, {node}, -0.5, 0., 0.{hinge}, 0., 0., 0.{hinge}")
        else:
            model.joint(f"{joint} hinge, {node - 1}, 0.5, 0., 0.{hinge}, {node}, -0.5, 0., 0.{hinge}")
    return model, links


def slider_crank():
    model = Model()
    crank = model.node("0.1, 0., 0.", velocity="0., 0., -2.", rate="0., 20., 0.")
    rod = model.node("0.5, 0., 0.", velocity="0., 0., -2.", rate=f"0., {-20 / 3:.15g}, 0.")
    piston = model.node("0.8, 0., 0.")
    model.body(crank, 1, "0.001, 0.004, 0.004")
    model.body(rod, 2, "0.001, 0.06, 0.06")
    model.body(piston, 1, "0.001, 0.001, 0.001")
    model.joint(f"revolute pin, {crank}, -0.1, 0., 0., hinge, {ABOUT_Y}, 0., 0., 0., hinge, {ABOUT_Y}")
    model.joint(f"spherical hinge, {crank}, 0.1, 0., 0., {rod}, -0.3, 0., 0.")
    axes = "3, 0.,1.,0., 2, 0.,0.,1."
    model.joint(f"cardano hinge, {rod}, 0.3, 0., 0., hinge, {axes}, {piston}, null, hinge, {axes}")
    model.joint(f"total pin joint, {piston}, position, null, position, 0.8, 0., 0., position constraint, 0, 1, 1, null, "
                "orientation constraint, 1, 1, 1, null")
    model.element("couple", "forces", f'absolute, {crank}, 0., 1., 0., string, "2.*sin(30.*Time)"')
    return model, piston


def spin_up(elements=10):
    model, length = Model(), 10 / elements
    model.has_gravity = False
    for k in range(elements + 1):
        share = length * (0.5 if k in (0, elements) else 1)
        node = model.node(f"{k * length}, 0., 0.")
        model.body(node, 1.2 * share, f"{1.2e-3 * share}, {6e-4 * share}, {6e-4 * share}")
    for k in range(1, elements + 1):
        model.element("beam2", "beams", f"{k}, null, {k + 1}, null, eye, linear elastic generic, "
                      "diag, 2.8e7, 1.e7, 1.e7, 1.4e4, 1.4e4, 1.4e4")
    angle = "(Time<15.)*0.4*(Time^2/2.+(15./(2.*pi))^2*(cos(2.*pi*Time/15.)-1.))+(Time>=15.)*(6.*Time-45.)"
    model.joint("total pin joint, 1, position, null, position, null, position constraint, 1, 1, 1, null, "
                f'orientation constraint, 1, 1, 1, 0., 0., 1., string, "{angle}"')
    return model, elements + 1


def modal_bar(fem, modes, root, tip):
    """@param fem  path of the body for MBDyn  @param modes  count of its modes  @param root, tip  numbers of its nodes"""
    model = Model()
    model.start_tolerance = 1e30  # MBDyn 1.7.3 does not find the first accelerations of a modal joint on a hinge
    frame = model.node("null", kind="modal")
    held, end = model.node("null", kind="static"), model.node("1., 0., 0.", kind="static")
    model.joint(f'modal, {frame}, {modes}, from file, no damping, "{fem}", 2, {root}, {held}, null, {tip}, {end}, null')
    model.joint(f"revolute pin, {held}, null, hinge, {ABOUT_Y}, null, hinge, {ABOUT_Y}")
    return model, end


def modal_body(superelement, folder):
    """Writes the body of a superelement for MBDyn, without groups 14 and above, which MBDyn of 2021 does not read.
    @returns its path, the count of modes, and the numbers of the first two nodes"""
    path = os.path.join(folder, "bar.fem")
    subprocess.run([os.path.join(ROOT, "tools", "bielle-exchange"), superelement, path], check=True, capture_output=True)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.split("** RECORD GROUP 14")[0])
    lines = text.splitlines()
    _, _, modes, *_ = next(line for line in lines if line.strip().startswith("REV0")).split()
    numbers = lines[next(k for k, line in enumerate(lines) if "RECORD GROUP 2," in line) + 1].split()
    return path, int(modes), *numbers[:2]


def models(superelement, folder):
    """@returns {name as in timed_models: (model, number of the node that has the motion of Bielle's in COMPARED_NODES)}"""
    return {"slider-crank": slider_crank(), "superelement, 30 modes": modal_bar(*modal_body(superelement, folder)),
            "spin-up, 10 beams": spin_up(), "100 spherical": chain(100, "spherical"), "100 hinges": chain(100, "revolute"),
            "500 spherical": chain(500, "spherical")}


def write_input(path, model, steps, size, setting, every=0):
    with open(path, "w", encoding="utf-8") as file:
        file.write(model.text(steps, size, setting, every))


def command(program, path, output):
    return [program, "-f", path, "-o", output, "-s"]


def fastest_setting(program, model, steps, size, folder):
    """Runs a model once with each setting. @returns the fastest setting that converges"""
    times = {}
    for setting in SETTINGS:
        path = os.path.join(folder, "tried.mbd")
        write_input(path, model, steps, size, setting)
        try:
            times[setting] = Run(command(program, path, os.path.join(folder, "tried")), folder).seconds
        except RuntimeError:
            continue  # this setting does not converge
    return min(times, key=times.get)


def last_position(output, node):
    """@param output  path of the output without ending  @returns the last position of a node in a text file of motions [m]"""
    with open(output + ".mov", encoding="utf-8") as file:
        rows = [line.split() for line in file]
    return [float(word) for word in next(row for row in reversed(rows) if int(row[0]) == node)[1:4]]
