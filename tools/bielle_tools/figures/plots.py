"""Figures of a results file: energies, joints, nodes, bodies, beams, eigenvalues and responses.

Every function draws one subject and returns the paths it wrote: none if the results contain nothing of it.
"""

import os

import numpy as np

from ..bodies.superelement_body import superelement_of
from ..messages import InputError
from ..results.columns import column_names, column_units, columns_of
from ..results.results_file import Results
from . import campbell_figure, mode_figures
from . import plot_style as style

ENERGY_COLOURS = dict(zip(("kinetic", "elastic", "gravity", "dissipated", "input"), style.COLOURS))
MOST_CURVES = 14  # per panel; more cannot be told apart


def draw_all(results, folder, extension="png", nodes=None, joints=None, superelements=None, rotation="rotation_vector"):
    """Draws every figure that the results allow. nodes, joints: names to show instead of all; rotation: the quantity of
    ROTATION_QUANTITIES in which rotations of nodes are shown. @returns paths"""
    os.makedirs(folder, exist_ok=True)

    def at(name):
        return os.path.join(folder, f"{name}.{extension}")

    written = []
    if len(results.time) > 1:
        with style.curves_of(len(results.time)):
            written += energy(results, at)
            written += joint_motion(results, at, joints)
            written += joint_reactions(results, at, joints)
            written += drives(results, at, joints)
            written += node_paths(results, at, nodes)
            written += node_rotations(results, at, nodes, rotation)
            written += bodies(results, at, superelements or {})
            written += beams(results, at)
            written += circuit(results, at)
            written += signals(results, at)
            written += solver(results, at)
    written += eigenfrequencies(results, at)
    written += mode_figures.draw(results, at, superelements or {})
    written += campbell_figure.draw(results, at)
    written += frequency_response(results, at)
    if not written:
        raise InputError(f"'{results.path}' holds nothing to draw over time: "
                         + ("it has one time only, which bielle-view shows" if len(results.time) == 1 else "nothing in it changes or nothing is recorded"))
    return written


def energy(results: Results, at):
    """Draws stored energies and input; small energies on a scale of their own; the error of the balance."""
    values = {name: results.rows(f"energy/{name}") for name in ("kinetic", "elastic", "gravity", "dissipated", "input")
              if results.has(f"energy/{name}")}
    reach = {name: _reach(v) for name, v in values.items()}
    values = {name: v for name, v in values.items() if np.any(v != 0)}
    if not values:
        return []
    small = [name for name in values if reach[name] < 0.03 * max(reach.values())]
    shown = [("energy [J]", [name for name in values if name not in small]), ("small ones [J]", small)]
    shown = [(text, names) for text, names in shown if names]
    balance = results.has("energy/balance") and not (results.static and not np.any(results.rows("energy/balance")))
    fig, axes = style.figure(len(shown) + balance, f"{results.title}: energy")
    for panel, (text, names) in zip(axes[:, 0], shown):
        for name in names:
            panel.plot(results.time, values[name], label=name, color=ENERGY_COLOURS[name],
                       linestyle="--" if name == "input" else "-")
        panel.set_ylabel(text)
        style.legend(panel)
    if balance:
        panel = axes[-1, 0]
        panel.plot(results.time, results.rows("energy/balance"), color="black")
        panel.set_ylabel("missing [J]")
        panel.set_title("balance: stored - stored at the start - input + dissipated"
                        + ("" if results.static else " (negative: taken by the time integration)"))
    axes[-1, 0].set_xlabel(results.axis)
    return [style.save(fig, at("energy"))]


def joint_motion(results, at, joints=None):
    """A line of panels per joint and kind of coordinate: those of one unit share a panel.

    Unless joints are named, kinds that move less than a millionth of others of that unit, or than rounding, are left out.
    """
    panels, reach = [], {}  # (joint, units, columns); units -> largest range
    for joint in joints or results.names("joints"):
        kinds = {}
        values = columns_of(results, f"joints/{joint}/coordinate")
        for k, units in enumerate(column_units(results, f"joints/{joint}/coordinate")):
            kinds.setdefault(units, []).append(k)
        for units, columns in kinds.items():
            moved = max(_reach(values[k]) for k in columns)
            reach[units] = max(reach.get(units, 0), moved)
            panels.append((joint, units, columns, moved))
    panels = [(joint, units, columns) for joint, units, columns, moved in panels if joints or moved > max(1e-6 * reach[units], 1e-12)]
    if not panels:
        return []
    fig, axes = style.figure(len(panels), f"{results.title}: joint coordinates and rates", columns=2, width=12)
    for (joint, units, columns), line in zip(panels, axes):
        for panel, quantity, unit in zip(line, ("coordinate", "rate"), (units, f"{units}/s")):
            place = f"joints/{joint}/{quantity}"
            labels, values = column_names(results, place), columns_of(results, place)
            for k in columns if len(values) > columns[-1] else ():
                panel.plot(results.time, values[k], label=labels[k])
            panel.set_ylabel(style.label(quantity, unit))
            panel.set_title(joint)
        style.legend(line[1])
    for panel in axes[-1]:
        panel.set_xlabel(results.axis)
    return [style.save(fig, at("joints"))]


def joint_reactions(results, at, joints=None):
    names = [j for j in joints or results.names("joints") if results.has(f"joints/{j}/reaction")]
    if not names:
        return []
    fig, axes = style.figure(2, f"{results.title}: joint reactions")
    for name in names[:MOST_CURVES]:
        reaction = results.rows(f"joints/{name}/reaction")
        axes[0, 0].plot(results.time, np.linalg.norm(reaction[:, :3], axis=1), label=name)
        axes[1, 0].plot(results.time, np.linalg.norm(reaction[:, 3:], axis=1), label=name)
    axes[0, 0].set_ylabel("|force| [N]")
    axes[1, 0].set_ylabel("|moment| [N m]")
    axes[1, 0].set_xlabel(results.axis)
    style.legend(axes[0, 0])
    return [style.save(fig, at("reactions"))]


def drives(results, at, joints=None):
    """Draws the efforts of drives along the coordinates of their joints: a panel for forces, one for torques."""
    panels = {}
    for joint in joints or results.names("joints"):
        place = f"joints/{joint}/drive_force"
        names = column_names(results, f"joints/{joint}/coordinate")
        for k, (units, values) in enumerate(zip(column_units(results, place), columns_of(results, place))):
            if np.any(values != 0):
                panels.setdefault(units, []).append((f"{joint} {names[k]}" if 1 < len(names) > k else joint, values))
    if not panels:
        return []
    fig, axes = style.figure(len(panels), f"{results.title}: drives")
    for panel, (units, curves) in zip(axes[:, 0], panels.items()):
        for name, values in curves[:MOST_CURVES]:
            panel.plot(results.time, values, label=name)
        panel.set_ylabel(style.label("torque" if "m" in units else "force", units))
        style.legend(panel)
    axes[-1, 0].set_xlabel(results.axis)
    return [style.save(fig, at("drives"))]


def node_paths(results, at, nodes=None):
    """Draws paths in the inertial plane in which the nodes move most, and the distance of each over time."""
    names = nodes or results.names("nodes")
    paths = {name: results.rows(f"nodes/{name}/position") for name in names if results.has(f"nodes/{name}/position")}
    reach = {name: np.array([_reach(column) for column in path.T]) for name, path in paths.items()}
    largest = max((r.max() for r in reach.values()), default=0)
    if nodes is None:
        paths = {name: path for name, path in paths.items() if reach[name].max() > 1e-6 * largest}
    if not paths or largest == 0:
        return []
    total = np.max([reach[name] for name in paths], axis=0)
    a, b = sorted(np.argsort(-total, kind="stable")[:2])
    fig, axes = style.figure(1, f"{results.title}: node paths", height=5.0)
    panel = axes[0, 0]
    for name, path in list(paths.items())[:MOST_CURVES]:
        line, = panel.plot(path[:, a], path[:, b], label=name)
        panel.plot(*path[0, [a, b]], "o", color=line.get_color(), markersize=4)
    panel.set_aspect("equal", adjustable="datalim")
    panel.set_xlabel(f"{'xyz'[a]} [m]")
    panel.set_ylabel(f"{'xyz'[b]} [m]")
    panel.set_title("a dot marks the start")
    style.legend(panel)
    return [style.save(fig, at("paths"))]


def node_rotations(results, at, nodes=None, quantity="rotation_vector"):
    """Orientations of nodes over time, continuous over turns: a panel per component. Unless nodes are named, those that turn by
    less than a millionth of the largest turn, or than rounding, are left out."""
    places = {name: f"nodes/{name}/{quantity}" for name in nodes or results.names("nodes")}
    places = {name: place for name, place in places.items() if results.has(place)}
    turned = {name: max(_reach(column) for column in columns_of(results, place)) for name, place in places.items()}
    least = -1 if nodes else max(1e-6 * max(turned.values(), default=0), 1e-12)
    shown = [name for name in places if turned[name] > least][:MOST_CURVES]
    if not shown:
        return []
    curves = {name: results.rows(places[name]) for name in shown}
    words = "rotation vectors" if quantity == "rotation_vector" else f"{quantity.capitalize()} angles"
    place = places[shown[0]]
    fig, axes = style.figure(3, f"{results.title}: {words} of nodes")
    axes[0, 0].set_title(results.text(place, "description").partition(",")[0])
    for k, (panel, component) in enumerate(zip(axes[:, 0], column_names(results, place))):
        for name, values in curves.items():
            panel.plot(results.time, values[:, k], label=name)
        panel.set_ylabel(style.label(component, "rad"))
    style.legend(axes[0, 0])
    axes[-1, 0].set_xlabel(results.axis)
    return [style.save(fig, at("rotations"))]


def bodies(results, at, superelements):
    """Draws for each superelement the elastic displacement of the node that moves most, and the highest stress of the
    body."""
    written = []
    for name in results.elements_with("frame", "coordinates"):
        body = superelement_of(results, name, superelements)
        q = results.rows(f"elements/{name}/coordinates")
        largest, row = 0.0, 0  # row: of the recovery, whose node moves most
        for block in body.blocks(results.frames(count=60)):
            u = np.linalg.norm(body.local_displacement(q[block])[:, body.displaced], axis=-1)
            u = np.where(np.isfinite(u), u, 0).max(axis=0, initial=0)
            if u.max(initial=0) > largest:
                largest, row = u.max(), int(u.argmax())
        if not len(body.displaced):
            continue
        node = body.displaced[row]
        u = q @ body.displacement[3 * row:3 * row + 3].T
        has_stress = body.stress is not None and len(body.stress)
        fig, axes = style.figure(2 if has_stress else 1, f"{results.title}: {name}")
        place = ", ".join(f"{1e3 * x:.4g}" for x in body.points[node].round(9) + 0.0)
        axes[0, 0].set_title(f"elastic displacement of the node that moves most, at ({place}) mm in the body")
        for k in range(3):
            axes[0, 0].plot(results.time, 1e3 * u[:, k], label="xyz"[k])
        axes[0, 0].set_ylabel("displacement [mm]")
        style.legend(axes[0, 0])
        if has_stress:
            rows = results.frames(count=400)
            peak = np.concatenate([np.nanmax(body.von_mises(q[block]), axis=1) for block in body.blocks(rows)])
            axes[1, 0].plot(results.time[rows], 1e-6 * peak)
            axes[1, 0].set_ylabel("von Mises [MPa]")
            axes[1, 0].set_title("highest von Mises stress of the body")
        axes[-1, 0].set_xlabel(results.axis)
        written.append(style.save(fig, at(f"body_{name}")))
    return written


def beams(results, at):
    written = []
    for name in results.elements_with("position", "rotation", "resultants"):
        values = results.rows(f"elements/{name}/resultants")  # (nt,ne,6): N Qy Qz T My Mz
        quantities = {"axial force": values[:, :, 0], "|shear force|": np.linalg.norm(values[:, :, 1:3], axis=2),
                      "torque": values[:, :, 3], "|bending moment|": np.linalg.norm(values[:, :, 4:], axis=2)}
        stressed = results.has(f"elements/{name}/von_mises") and len(results.shape(f"elements/{name}/von_mises")) == 3
        if not values.shape[1]:
            continue
        fig, axes = style.figure(3 if stressed else 2, f"{results.title}: beam {name}")
        axes[0, 0].set_title("in the first element; dashed: in the last one")
        for index, (text, value) in enumerate(quantities.items()):
            panel = axes[index // 2, 0]
            panel.plot(results.time, value[:, 0], label=text, color=style.COLOURS[index])
            panel.plot(results.time, value[:, -1], linestyle="--", color=style.COLOURS[index])
        axes[0, 0].set_ylabel("force [N]")
        axes[1, 0].set_ylabel("moment [N m]")
        if stressed:
            stress = results.rows(f"elements/{name}/von_mises")  # (nt,ne,np)
            axes[2, 0].plot(results.time, 1e-6 * stress.max(axis=(1, 2), initial=0), color="black")
            axes[2, 0].set_ylabel("von Mises [MPa]")
            axes[2, 0].set_title("highest von Mises stress at the section's stress points")
        axes[-1, 0].set_xlabel(results.axis)
        for panel in axes[:, 0]:
            style.legend(panel)
        written.append(style.save(fig, at(f"beam_{name}")))
    return written


def circuit(results, at):
    """Draws a hydraulic circuit: pressures of places, flows of lines, openings of valves, powers.

    If a dataset has many columns (cells of pipes), the first and the last are drawn; of too many curves those that vary
    most.
    """
    panels = []
    for quantity in ("pressure", "flow", "opening", "power"):
        curves, units = [], ""
        for name in results.names("hydraulics"):
            place = f"hydraulics/{name}/{quantity}"
            columns = columns_of(results, place)
            if not columns or (quantity == "flow" and results.has(f"hydraulics/{name}/pressure")):
                continue  # the pressures show the same as net flows of places
            units = results.units(place)
            names = column_names(results, place) if len(columns) > 1 else [""]
            shown = range(len(columns)) if len(columns) <= 6 else (0, len(columns) - 1)
            curves += [(f"{name} {names[k]}".strip(), columns[k]) for k in shown]
        if len(curves) > MOST_CURVES:
            most = sorted(curves, key=lambda curve: -np.ptp(curve[1]))[:MOST_CURVES]
            curves = [curve for curve in curves if any(curve is other for other in most)]
        if curves:
            panels.append((style.label(quantity, units), curves))
    if not panels:
        return []
    fig, axes = style.figure(len(panels), f"{results.title}: hydraulics", height=3.2)
    for panel, (label, curves) in zip(axes[:, 0], panels):
        for k, (name, values) in enumerate(curves):
            panel.plot(results.time, values, label=name, linestyle="-" if k < len(style.COLOURS) else "--")
        panel.set_ylabel(label)
        style.legend(panel)
    axes[-1, 0].set_xlabel(results.axis)
    return [style.save(fig, at("hydraulics"))]


def signals(results, at):
    """Draws the remaining datasets: actuators, springs, contacts, points; a panel per dataset with few columns over
    time.

    Rigid bodies are left out: the paths of their nodes show the same.
    """
    written = []
    drawn = set(results.elements_with("frame") + results.elements_with("rotation") + results.elements_with("angular_momentum"))
    for section in ("elements", "contacts", "points"):
        for name in results.names(section):
            if section == "elements" and name in drawn:
                continue
            places = {q: f"{section}/{name}/{q}" for q in results.datasets(f"{section}/{name}")}
            shapes = {q: results.shape(place) for q, place in places.items()}
            places = {q: place for q, place in places.items() if len(shapes[q]) in (1, 2) and shapes[q][0] >= len(results.time)}
            places = {q: place for q, place in places.items() if 0 < len(columns_of(results, place)) <= 6}
            if not places:
                continue
            fig, axes = style.figure(len(places), f"{results.title}: {name}")
            for panel, (quantity, place) in zip(axes[:, 0], places.items()):
                columns = columns_of(results, place)
                for k, column in enumerate(columns):
                    panel.plot(results.time, column, label=column_names(results, place)[k] if len(columns) > 1 else None)
                panel.set_ylabel(style.label(quantity, results.units(place)))
                style.legend(panel)
            axes[-1, 0].set_xlabel(results.axis)
            written.append(style.save(fig, at(f"{section[:-1]}_{name}".replace("/", "_"))))
    return written


def solver(results, at):
    names = [n for n in ("step", "newton_iterations", "error_estimate")
             if results.has(f"solver/{n}") and _varies(results.rows(f"solver/{n}")[1:])]
    if not names:
        return []
    fig, axes = style.figure(len(names), f"{results.title}: solver")
    for panel, name in zip(axes[:, 0], names):
        middle, low, mean, high = binned(results.time, results.rows(f"solver/{name}"))
        panel.fill_between(middle, low, high, color=style.COLOURS[0], alpha=0.25, linewidth=0)
        panel.plot(middle, mean)
        if name == "newton_iterations":
            panel.set_ylim(bottom=0)
        elif low.min() > 0:
            panel.set_yscale("log")
        panel.set_ylabel(style.label(name.replace("_", "\n"), results.units(f"solver/{name}")))
    if len(middle) < len(results.time):
        axes[0, 0].set_title(f"mean and range of {len(results.time) // len(middle)} recorded steps at a time")
    axes[-1, 0].set_xlabel(results.axis)
    return [style.save(fig, at("solver"))]


def eigenfrequencies(results, at):
    if not results.has("eigen/frequency"):
        return []
    frequency = results.array("eigen/frequency")
    if frequency.ndim != 1 or frequency.dtype.kind not in "fiu":
        raise InputError(f"'{results.path}': 'eigen/frequency' is damaged: it is no list of numbers")
    fig, axes = style.figure(1, f"{results.title}: eigenfrequencies", height=3.2)
    panel = axes[0, 0]
    bars = panel.bar(np.arange(1, len(frequency) + 1), frequency, color=style.COLOURS[0])
    panel.bar_label(bars, labels=[f"{f:.4g}" for f in frequency], fontsize=8)
    panel.set_xlabel("mode")
    panel.set_ylabel("frequency [Hz]")
    panel.xaxis.get_major_locator().set_params(integer=True)
    return [style.save(fig, at("eigenfrequencies"))]


def frequency_response(results, at):
    if not results.has("frequency_response/response"):
        return []
    frequency = results.array("frequency_response/frequency")
    response = results.array("frequency_response/response")
    if response.ndim != 4 or response.shape[-1] != 2 or frequency.shape != response.shape[:1]:
        raise InputError(f"'{results.path}': 'frequency_response' is damaged: its frequencies and responses do not fit together")
    response = response[..., 0] + 1j * response[..., 1]  # (nf,outputs,inputs)
    fig, axes = style.figure(2, f"{results.title}: frequency response")
    for o in range(response.shape[1]):
        for i in range(response.shape[2]):
            text = f"output {o + 1} / input {i + 1}"
            axes[0, 0].loglog(frequency, np.abs(response[:, o, i]), label=text)
            axes[1, 0].semilogx(frequency, np.degrees(np.angle(response[:, o, i])), label=text)
    axes[0, 0].set_ylabel("magnitude")
    axes[1, 0].set_ylabel("phase [degrees]")
    axes[1, 0].set_xlabel("frequency [Hz]")
    style.legend(axes[0, 0])
    return [style.save(fig, at("frequency_response"))]


def binned(time, values, most=150):
    """Middle, least, mean and largest value of `most` groups of neighbouring rows; the rows themselves when there are few.

    The start, row 0, has no step and is left out.
    """
    time, values = time[1:], values[1:]
    groups = np.array_split(np.arange(len(time)), min(most, len(time)))
    return tuple(np.array([reduce(of[rows]) for rows in groups])
                 for reduce, of in ((np.mean, time), (np.min, values), (np.mean, values), (np.max, values)))


def _varies(values):
    """Tells whether values vary by more than rounding: steps that end at a given time differ in their last digits."""
    return len(values) > 0 and _reach(values) > 1e-6 * np.nanmax(np.abs(values))


def _reach(values):
    """Largest minus smallest of the finite values; 0 if there are none."""
    values = values[np.isfinite(values)]
    return np.ptp(values) if len(values) else 0.0
