"""Tests of bielle-paraview, bielle-plot and bielle-animate with results whose motion is known in closed form."""

import json
import os
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

import h5py
import matplotlib.image
import meshio
import numpy as np

import synthetic_results as synthetic
from box_mesh import REPOSITORY, InFolder
from python_tool import import_tools, prepare_figures, run_python_tool, users_style  # box_mesh sets the path
from shares import share_of_tests as load_tests  # noqa: E402,F401


class ResultsTool(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        import_tools()
        prepare_figures()

    def setUp(self):
        super().setUp()
        self.points, self.cells = synthetic.write_superelement(self.path("box.h5"))
        self.time = synthetic.write_results(self.path("run.h5"), "box.h5")

    def run_tool(self, tool, *arguments):
        return run_python_tool(os.path.join(REPOSITORY, "tools", tool), arguments, environment={**os.environ, "DISPLAY": ""})

    def succeed(self, tool, *arguments):
        done = self.run_tool(tool, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refuse(self, tool, arguments, *parts):
        done = self.run_tool(tool, *arguments)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr.splitlines()[-1])


class ParaView(ResultsTool):
    def parts(self, pvd):
        """Returns {part: [(time, mesh)]} of a .pvd file."""
        parts = {}
        for entry in ElementTree.parse(pvd).getroot().iter("DataSet"):
            mesh = meshio.read(os.path.join(os.path.dirname(pvd), entry.get("file")))
            parts.setdefault(entry.get("name"), []).append((float(entry.get("timestep")), mesh))
        return parts

    def test_bodies_move_and_deform_as_the_closed_form_says(self):
        for scale, options in ((1.0, ["--volume"]), (50.0, ["--volume", "--scale", "50"]), (1.0, [])):
            self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "9", *options)
            rod = self.parts(self.path("run.pvd"))["rod"]
            self.assertEqual(len(rod), 9)
            for time, mesh in rod:
                everywhere = synthetic.positions(self.points, time, scale)
                if options:
                    np.testing.assert_allclose(mesh.points, everywhere, atol=1e-12)
                else:
                    gap = np.linalg.norm(mesh.points[:, None] - everywhere[None], axis=2).min(axis=1)
                    self.assertLess(gap.max(), 1e-12)
                    self.assertEqual({block.type for block in mesh.cells}, {"triangle6"})
                elastic = np.linalg.norm(mesh.point_data["displacement"], axis=1)
                self.assertAlmostEqual(elastic.max(), abs(synthetic.strain(time)) * 0.3, delta=1e-12)
                stress = mesh.point_data["von_mises"]
                known = stress[~np.isnan(stress)]
                self.assertGreater(len(known), 0)
                np.testing.assert_allclose(known, synthetic.YOUNG * abs(synthetic.strain(time)), rtol=1e-9, atol=1e-3)

    def test_second_order_cells_keep_their_mid_side_nodes(self):
        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "3", "--volume")
        _, mesh = self.parts(self.path("run.pvd"))["rod"][0]
        edges = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]]  # VTK's quadratic tetrahedron
        cells = mesh.cells_dict["tetra10"]
        np.testing.assert_allclose(mesh.points[cells[:, 4:]], mesh.points[cells[:, edges]].mean(axis=2), atol=1e-12)

    def test_vtk_itself_reads_the_files(self):
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "2")
        for part, kind in (("rod", 22), ("beams", 3), ("nodes", 1), ("joints", 1)):  # quadratic triangle, line, vertex
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(self.path(f"run/{part}_0001.vtu"))
            reader.Update()
            grid = reader.GetOutput()
            self.assertGreater(grid.GetNumberOfPoints(), 0)
            self.assertEqual(grid.GetCellType(0), kind)

    def test_beams_nodes_and_joints(self):
        self.succeed("bielle-paraview", self.path("run.h5"), "--every", "20")
        parts = self.parts(self.path("run.pvd"))
        self.assertEqual(set(parts), {"rod", "rigid", "beams", "nodes", "joints"})
        np.testing.assert_allclose([time for time, _ in parts["nodes"]], self.time[::20], rtol=1e-8)
        time, beams = parts["beams"][-1]
        np.testing.assert_allclose(beams.points[:, 2], np.linspace(0, 0.2, synthetic.BEAM_NODES), atol=1e-15)
        np.testing.assert_allclose(beams.cell_data["axial_force"][0], [10, 20, 30, 40])
        np.testing.assert_allclose(beams.cell_data["von_mises"][0], np.array([10, 20, 30, 40]) * 1e6)
        time, nodes = parts["nodes"][1]
        np.testing.assert_allclose(nodes.points, [[synthetic.SPEED * time, 0, 0]], atol=1e-15)
        c, s = np.cos(synthetic.OMEGA * time), np.sin(synthetic.OMEGA * time)
        np.testing.assert_allclose(nodes.point_data["axis_x"], [[c, s, 0]], atol=1e-12)
        np.testing.assert_allclose(nodes.point_data["axis_y"], [[-s, c, 0]], atol=1e-12)
        np.testing.assert_allclose(parts["joints"][0][1].point_data["reaction_force"], [[3, 4, 0]])
        np.testing.assert_allclose(parts["joints"][0][1].point_data["drive_force"], [[0, 7]])

    def test_axes_of_sections_at_the_ends_of_beams(self):
        """Inner nodes have the axes of the section, which are the inertial ones; the drawing rotates those of the
        ends."""
        half = np.sqrt(0.5)
        item = {"entry": "elements/shaft", "type": "beam", "shape": "beam", "element": "elements/shaft", "turn": [[half, half, 0, 0], [0, 1, 0, 0]]}
        with h5py.File(self.path("run.h5"), "r+") as file:
            file["drawing"] = json.dumps({"format": "bielle drawing", "version": 1, "name": "", "items": [item]})
        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "2")
        data = self.parts(self.path("run.pvd"))["beams"][0][1].point_data
        np.testing.assert_allclose(data["section_y"], [[0, 0, 1], *[[0, 1, 0]] * (synthetic.BEAM_NODES - 2), [0, -1, 0]], atol=1e-12)
        np.testing.assert_allclose(data["section_z"], [[0, -1, 0], *[[0, 0, 1]] * (synthetic.BEAM_NODES - 2), [0, 0, -1]], atol=1e-12)

    def test_a_rigid_body_is_the_ellipsoid_of_its_inertia(self):
        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "3")
        for time, mesh in self.parts(self.path("run.pvd"))["rigid"]:
            c, s = np.cos(synthetic.OMEGA * time), np.sin(synthetic.OMEGA * time)
            local = (mesh.points - [synthetic.SPEED * time, 0, 0]) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
            np.testing.assert_allclose((((local - synthetic.CENTRE) / synthetic.SEMI_AXES) ** 2).sum(axis=1), 1, atol=1e-6)
            corners = mesh.points[mesh.cells_dict["triangle"]]
            # The volume is positive if triangles point outward.
            volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
            self.assertAlmostEqual(volume / (4 / 3 * np.pi * synthetic.SEMI_AXES.prod()), 1, delta=0.15)  # volume of
                                                                                                          # its facets

    def test_a_static_analysis_says_that_its_time_is_a_load_factor(self):
        synthetic.write_results(self.path("static.h5"), "box.h5", rows=3, analysis="static")
        self.assertIn("load factor of a static analysis", self.succeed("bielle-paraview", self.path("static.h5")).stdout)
        self.assertNotIn("load factor", self.succeed("bielle-paraview", self.path("run.h5")).stdout)
        self.refuse("bielle-paraview", [self.path("static.h5"), "--from", "3"], "no load factor from 3")
        # The other figures are removed, since they would take four fifths of the time.
        with h5py.File(self.path("static.h5"), "r+") as file:
            for name in ("nodes", "joints", "elements", "solver"):
                del file[name], file[f"analysis_1/{name}"]
        self.succeed("bielle-plot", self.path("static.h5"), "--format", "svg", "-o", self.path("plots"))
        self.assertEqual(self.labels("plots/energy.svg"), {"load factor", "energy [J]", "missing [J]"})

    def labels(self, picture):
        """Returns the texts of the axes of an SVG figure. Matplotlib writes each as a comment before its outlines."""
        with open(self.path(picture), encoding="utf-8") as file:
            texts = set(re.findall(r"<!-- (.*?) -->", file.read()))
        return {text for text in texts if "[" in text or text in ("load factor",)}

    def test_a_span_of_time(self):
        self.succeed("bielle-paraview", self.path("run.h5"), "--from", "0.02", "--to", "0.05", "--frames", "4")
        times = [time for time, _ in self.parts(self.path("run.pvd"))["nodes"]]
        np.testing.assert_allclose(times, [0.02, 0.03, 0.04, 0.05], atol=1e-9)
        self.refuse("bielle-paraview", [self.path("run.h5"), "--from", "3"], "no time from 3", "it has 0 to 0.1 s")

    def test_an_earlier_export_leaves_no_frames_behind(self):
        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "20")
        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "2")
        self.assertEqual(len([f for f in os.listdir(self.path("run")) if f.startswith("rod_")]), 2)

    def test_interrupted_run_shows_the_rows_that_count(self):
        synthetic.write_results(self.path("run.h5"), "box.h5", rows=5, complete=False, extra_rows=3)
        done = self.succeed("bielle-paraview", self.path("run.h5"))
        self.assertEqual(len(self.parts(self.path("run.pvd"))["nodes"]), 5)
        self.assertIn("not completed", done.stderr)

    def test_superelement_elsewhere(self):
        os.makedirs(self.path("other"))
        os.replace(self.path("box.h5"), self.path("other/box.h5"))
        self.refuse("bielle-paraview", [self.path("run.h5")], "'rod'", "box.h5", "--superelement rod=PATH")
        self.succeed("bielle-paraview", self.path("run.h5"), "--superelement", "rod=" + self.path("other/box.h5"))

    def test_pieces_of_a_body_stand_in_one_file(self):
        with h5py.File(self.path("box.h5")) as whole, h5py.File(self.path("cut.h5"), "w") as cut:
            cut.attrs["format"] = "bielle cut body"
            whole.copy(whole["/"], cut, "pieces/1")
        with h5py.File(self.path("run.h5"), "r+") as run:
            run["elements"].move("rod", "rod.1")
            run["elements/rod.1"].attrs.update({"file": "cut.h5", "group": "/pieces/1"})
        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "3", "--volume")
        last = self.parts(self.path("run.pvd"))["rod.1"][-1][1]
        self.assertEqual(len(last.points), len(self.points))
        os.makedirs(self.path("other"))
        os.replace(self.path("cut.h5"), self.path("other/cut.h5"))
        self.refuse("bielle-paraview", [self.path("run.h5")], "'rod.1'", "cut.h5", "--superelement rod=PATH")
        self.succeed("bielle-paraview", self.path("run.h5"), "--superelement", "rod=" + self.path("other/cut.h5"))
        with h5py.File(self.path("other/cut.h5"), "r+") as cut:
            cut.move("pieces/1", "pieces/2")
        self.refuse("bielle-paraview", [self.path("run.h5"), "--superelement", "rod=" + self.path("other/cut.h5")],
                    "has no piece '/pieces/1'", "reduced again")


class Plots(ResultsTool):
    def test_every_figure_is_there_and_not_blank(self):
        with matplotlib.rc_context(users_style):
            done = self.succeed("bielle-plot", self.path("run.h5"), "-o", self.path("plots"))
        written = done.stdout.split()
        expected = {"energy", "joints", "reactions", "drives", "paths", "rotations", "body_rod", "beam_shaft", "element_ram", "solver"}
        self.assertEqual({os.path.splitext(os.path.basename(p))[0] for p in written}, expected)
        for path in written:
            picture = matplotlib.image.imread(path)[:, :, :3]
            inked = (picture < 0.8).any(axis=2).mean()
            self.assertGreater(inked, 0.005, path)
            self.assertGreater(min(picture.shape[:2]), 300, path)

    def test_eigenfrequencies_and_responses(self):
        with h5py.File(self.path("run.h5"), "a") as file:
            del file["time"]
            synthetic.put(file, "eigen/frequency", np.array([10.0, 20.0, 35.5]), "Hz")
            frequency = np.geomspace(1, 100, 50)
            response = 1 / (1 - (frequency / 20) ** 2 + 0.02j * frequency / 20)
            synthetic.put(file, "frequency_response/frequency", frequency, "Hz")
            synthetic.put(file, "frequency_response/response", np.stack([response.real, response.imag], -1)[:, None, None], "")
        done = self.succeed("bielle-plot", self.path("run.h5"), "-o", self.path("plots"))
        self.assertEqual(sorted(map(os.path.basename, done.stdout.split())), ["eigenfrequencies.png", "frequency_response.png"])

    def test_one_analysis_of_several(self):
        with h5py.File(self.path("run.h5"), "a") as file:
            for name in ("time", "nodes", "energy"):
                file.copy(file[name], file.require_group("analysis_1"), name)
        done = self.succeed("bielle-plot", self.path("run.h5"), "--analysis", "1", "-o", self.path("plots"))
        self.assertEqual({os.path.basename(p) for p in done.stdout.split()}, {"energy.png", "paths.png", "rotations.png"})
        self.refuse("bielle-plot", [self.path("run.h5"), "--analysis", "7"], "no analysis 7", "it has 1")

    def test_a_wrong_name_brings_the_nearest(self):
        self.refuse("bielle-plot", [self.path("run.h5"), "--nodes", "hubb"], "no node 'hubb'", "did you mean 'hub'?")
        self.refuse("bielle-plot", [self.path("run.h5"), "--joints", "zzz"], "no joint 'zzz'", "main")
        self.refuse("bielle-plot", [self.path("run.h5"), "--joints", ","], "expected the name of a joint", "main")
        for tool in ("bielle-paraview", "bielle-plot", "bielle-animate"):
            path = self.path("box.h5")
            self.refuse(tool, [self.path("run.h5"), "--superelement", "rdo=" + path], "'rdo'", "did you mean 'rod'?")
            self.refuse(tool, [self.path("run.h5"), "--superelement", "rod=" + path + "x"], "box.h5x", "does not exist")
            self.refuse(tool, [self.path("run.h5"), "--superelment", "rod=" + path], "did you mean '--superelement'?")
            self.refuse(tool, [self.path("run.h5"), "more.h5"],
                        "drawn over each other by --quantity" if tool == "bielle-plot" else "'more.h5' is one argument too many")

    def test_a_python_without_the_packages_says_what_to_do(self):
        for tool, module in (("bielle-plot", "matplotlib"), ("bielle-animate", "h5py"), ("bielle-paraview", "meshio"),
                             ("convert_mesh.py", "meshio"), ("bielle-study", "h5py")):
            # -S runs Python without the packages of the machine.
            done = subprocess.run(["/usr/bin/python3", "-B", "-S", os.path.join(REPOSITORY, "tools", tool)], text=True,
                                  capture_output=True, timeout=60)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            for text in (tool + ": /usr/bin/python3 has no ", module, "python3-" + module, "tools/install"):
                self.assertIn(text, done.stderr)

    def test_plots_need_no_library_that_they_do_not_use(self):
        hide = self.write("hide.py", "import runpy, sys\nhidden, *sys.argv = sys.argv[1:]\nfor name in [*hidden.split(','), *sys.modules]:\n"
                                     "    if name.partition('.')[0] in hidden.split(','):\n        sys.modules[name] = None\n"
                                     "sys.path.insert(0, sys.argv[0].rpartition('/')[0])\nrunpy.run_path(sys.argv[0], run_name='__main__')\n")
        tool = os.path.join(REPOSITORY, "tools", "bielle-plot")
        for hidden, options, status, says in (
                ("vtkmodules,scipy", [], 0, ""), ("vtkmodules,scipy", ["--quantity", "kinetic"], 0, ""),
                ("scipy", ["--quantity", "kinetic", "--spectrum"], 2, "has no scipy"), ("matplotlib", [], 2, "has no matplotlib")):
            done = run_python_tool(hide, [hidden, tool, self.path("run.h5"), "-o", self.path("plots"), *options])
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(says, done.stderr)

    def test_tools_print_the_version_of_their_program(self):
        program = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-mechanism")
        said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
        for tool in ("bielle-plot", "bielle-table", "bielle-study", "bielle-view", "bielle-exchange"):
            done = run_python_tool(os.path.join(REPOSITORY, "tools", tool), ["--version"], environment={**os.environ, "BIELLE_BIN": os.path.dirname(program)})
            self.assertEqual((done.returncode, done.stdout), (0, f"{tool} with {program}\n{said}"), done.stderr)

    def test_installed_tools_advise_to_use_apt(self):
        shutil.copytree(os.path.join(REPOSITORY, "tools", "bielle_tools"), self.path("tools/bielle_tools"), ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(os.path.join(REPOSITORY, "tools", "bielle-plot"), self.path("tools"))
        done = subprocess.run(["/usr/bin/python3", "-B", "-S", self.path("tools/bielle-plot")], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("run apt install python3-numpy python3-h5py python3-matplotlib python3-yaml\n", done.stderr)
        self.assertNotIn("tools/install", done.stderr)


class Pictures(ResultsTool):
    def test_sheet_and_movie(self):
        self.succeed("bielle-animate", self.path("run.h5"), "-o", self.path("sheet.png"), "--frames", "4")
        picture = matplotlib.image.imread(self.path("sheet.png"))[:, :, :3]
        self.assertGreater((picture < 0.8).any(axis=2).mean(), 0.01)
        from PIL import Image

        self.succeed("bielle-animate", self.path("run.h5"), "-o", self.path("run.gif"), "--frames", "5", "--view=z")
        with Image.open(self.path("run.gif")) as movie:
            self.assertEqual(movie.n_frames, 5)

    def test_unknown_output(self):
        self.refuse("bielle-animate", [self.path("run.h5"), "-o", self.path("run.avi")], "run.avi", ".gif")


class Refusals(ResultsTool):
    def test_every_tool_says_what_is_wrong_with_its_file(self):
        with open(self.path("text.h5"), "w", encoding="utf-8") as file:
            file.write("no HDF5")
        for tool in ("bielle-paraview", "bielle-plot", "bielle-animate"):
            self.refuse(tool, [self.path("none.h5")], "none.h5", "does not exist")
            self.refuse(tool, [self.path("text.h5")], "text.h5", "no HDF5 file")
            self.refuse(tool, [self.path("box.h5")], "results of bielle-mechanism", "a superelement", "bielle-reduce --inspect")
            self.refuse(tool, [self.path("run.h5"), "--superelement", "rod"], "ELEMENT=FILE.h5")
            self.refuse(tool, [self.path("run.h5"), "--colour", "red"], "--colour")

    TOOLS = {"bielle-paraview": [], "bielle-plot": [], "bielle-animate": [],
             "bielle-rainflow": ["joints/main/reaction", "--component", "6"], "bielle-table": ["--quantity", "main.reaction.rz"]}

    def refuse_everywhere(self, *parts):
        for tool, arguments in self.TOOLS.items():
            self.refuse(tool, [self.path("run.h5"), *arguments], "run.h5", *parts)

    def refuse_to_read(self, *parts):
        """The test uses the tool that starts fastest, since all open results in the same way."""
        self.refuse("bielle-rainflow", [self.path("run.h5"), *self.TOOLS["bielle-rainflow"]], "run.h5", *parts)

    def test_other_files_are_told_with_what_reads_them(self):
        def text(content):
            with open(self.path("run.h5"), "w", encoding="utf-8") as file:
                file.write(content)

        text("nodes: {a: {}}\nanalysis: []\n")
        self.refuse_everywhere("a mechanism file: 'bielle-mechanism' makes results of it")
        text("body: rod\ngeometry: rod.step\n")
        self.refuse_to_read("a body file: 'bielle-reduce' makes a superelement of it")
        text("")
        self.refuse_to_read("it is empty")
        with h5py.File(self.path("run.h5"), "w") as file:
            file.attrs["format"] = "bielle study"
        self.refuse_to_read("but a study: 'bielle-plot", "--quantity ..' draws its runs, which are the groups /runs/1, /runs/2")
        os.remove(self.path("run.h5"))
        os.mkdir(self.path("run.h5"))
        self.refuse_to_read("is a folder")

    def test_damaged_results(self):
        with open(self.path("run.h5"), "r+b") as file:
            file.truncate(5000)
        self.refuse_to_read("a damaged or truncated HDF5 file")
        synthetic.write_results(self.path("run.h5"), "box.h5", rows=0)
        self.refuse_to_read("holds no results yet")
        for place, values in (("time", np.zeros((41, 2))), ("joints/main/reaction", np.zeros(41))):
            synthetic.write_results(self.path("run.h5"), "box.h5")
            with h5py.File(self.path("run.h5"), "r+") as file:
                del file[place]
                file[place] = values
            for tool in ("bielle-plot", "bielle-rainflow"):
                self.refuse(tool, [self.path("run.h5"), *self.TOOLS[tool]], f"'{place}'", "damaged")

    def test_a_library_that_crashes_takes_only_its_own_process_along(self):
        script = "import os; from bielle_tools import messages; messages.run('tool', lambda _: os.abort(), crashing=True)"
        done = subprocess.run(["/usr/bin/python3", "-B", "-c", script], cwd=os.path.join(REPOSITORY, "tools"), text=True,
                              capture_output=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (1, "tool: a file is damaged: the HDF5 library crashes on it\n"))

    def test_what_is_missing_or_no_number_is_left_out(self):
        with h5py.File(self.path("run.h5"), "r+") as file:
            for place in ("energy/kinetic", "joints/main/rate", "joints/main/reaction_inertial", "elements/shaft/von_mises"):
                del file[place]
            file["nodes/hub/position"][20:] = np.nan
            file["elements/ram/pressure"][3, 0] = np.inf
        self.assertIn("'nodes/hub/position' holds values that are no numbers", self.succeed("bielle-plot", self.path("run.h5")).stderr)
        self.succeed("bielle-animate", self.path("run.h5"), "--frames", "4", "-o", self.path("run.png"))
        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "4")
        self.refuse("bielle-rainflow", [self.path("run.h5"), "elements/ram/pressure", "--component", "1"],
                    "values that are no numbers, the first at t = 0.0075 s")

    def test_results_with_one_time_only(self):
        synthetic.write_results(self.path("run.h5"), "box.h5", rows=1)
        for tool, says in (("bielle-plot", "one time only"), ("bielle-animate", "no motion"), ("bielle-rainflow", "does not change")):
            self.refuse(tool, [self.path("run.h5"), *self.TOOLS[tool]], says)

    def test_outputs_that_cannot_be_written(self):
        with open(self.path("file"), "w", encoding="utf-8"):
            pass
        for tool, ending in (("bielle-paraview", ".pvd"), ("bielle-plot", ""), ("bielle-animate", ".png"), ("bielle-animate", ".gif")):
            target = self.path("file/run" + ending)
            self.refuse(tool, [self.path("run.h5"), "-o", target], "file/run", "Not a directory")
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([os.path.join(REPOSITORY, "tools", "bielle-rainflow"), self.path("run.h5"), "joints/main/reaction",
                                   "--component", "6"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (2, "bielle-rainflow: cannot write: No space left on device\n"))

    def test_a_reader_that_goes_away_and_closed_streams(self):
        tool = f"'{os.path.join(REPOSITORY, 'tools', 'bielle-rainflow')}' '{self.path('run.h5')}' joints/main/reaction --component 6"
        for streams in ("| true", "| head -1 >/dev/null", ">&-", "<&- >&- 2>&-"):
            done = subprocess.run(["bash", "-c", f"{tool} {streams}; exit ${{PIPESTATUS[0]}}"], stderr=subprocess.PIPE, text=True,
                                  timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""), streams)

    def test_a_folder_with_other_things_keeps_them(self):
        os.mkdir(self.path("run"))
        with open(self.path("run/notes.txt"), "w", encoding="utf-8") as file:
            file.write("mine")
        self.succeed("bielle-paraview", self.path("run.h5"), "--frames", "2")
        self.assertTrue(os.path.exists(self.path("run/notes.txt")))

    def test_a_superelement_of_another_reduction(self):
        with h5py.File(self.path("box.h5"), "r+") as file:
            for name in ("displacement", "stress"):
                values = file[f"recovery/{name}"][()]
                del file[f"recovery/{name}"]
                file[f"recovery/{name}"] = np.column_stack([values, values])
        for tool in ("bielle-plot", "bielle-paraview", "bielle-animate"):
            self.refuse(tool, [self.path("run.h5")], "box.h5", "is not the superelement of 'rod': it has 4 coordinates",
                        "the results 2. Was it reduced again after the run?")

    def test_superelement_without_recovery(self):
        with h5py.File(self.path("box.h5"), "a") as file:
            del file["recovery"]
        self.refuse("bielle-paraview", [self.path("run.h5")], "recovery: {displacement: all}")


if __name__ == "__main__":
    unittest.main()
