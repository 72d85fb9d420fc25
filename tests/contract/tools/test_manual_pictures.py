"""Tests of the pictures of the manual: pages select them, they are not empty, and they are drawn once."""

import os
import re
import shutil
import sys
import unittest
import unittest.mock
import xml.dom.minidom

import numpy as np
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

from in_folder import REPOSITORY, InFolder  # noqa: E402

sys.path.insert(0, os.path.join(REPOSITORY, "tools"))

from bielle_tools.manual import gathering, pages, site  # noqa: E402
from bielle_tools.manual.example_pages import page_of, write_pages  # noqa: E402
from bielle_tools.manual.examples import examples_of  # noqa: E402
from bielle_tools.manual.pages import BLOCK  # noqa: E402
from bielle_tools.manual.gathering import Gathered, gather, runnable  # noqa: E402
from bielle_tools.manual.pictures import Picture, check_ink  # noqa: E402
from bielle_tools.messages import InputError  # noqa: E402
from quick_tools import quick_tools  # noqa: E402

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
PENDULUM = """# A pendulum

```yaml
# pendulum.yaml
mechanism: a pendulum
gravity: [0, 0, -9.81]
nodes:
  bob: {position: [0.5, 0, 0]}
elements:
  bob: {type: rigid_body, node: bob, solid: {sphere: 0.04, density: 7850}}
joints:
  pivot: {type: hinge, nodes: [ground, bob], position: [0, 0, 0], axis: [0, 1, 0]}
measures:
  height: {node: bob, direction: z}
analysis:
  - {type: dynamic, duration: 0.6, step: 0.002}
output: {every: 1000}
```
COMMENT
```sh
bielle-mechanism pendulum.yaml
bielle-table pendulum.h5 --quantity height --csv -
```
```text
...
0.6,-0.26125
...
```
"""


class Pages(InFolder):
    def page(self, text, name="page.md"):
        self.write(name, text)
        return self.path(name)

    def gathered(self, *names, **options):
        """Draws pages of the folder, and stores the reported sentences in `said`. @returns Gathered"""
        environment = {**pages.environment_of(REPOSITORY, PROGRAMS, gathering.TOOLS), "OPENBLAS_NUM_THREADS": "1"}
        self.said = []
        return gather(REPOSITORY, {name: self.path(name) for name in names}, PROGRAMS, environment, self.path("kept"), 2, self.said.append)


class Choice(Pages):
    def chosen(self, *lines):
        return examples_of(self.page("```yaml\n# a.yaml\nx: 1\n```\n" + "\n".join(lines) + "\n"))

    def test_a_run_of_a_file_of_the_page_is_an_example(self):
        one, = self.chosen("```sh", "bielle-mechanism a.yaml --set x=2 -o b.h5  # a remark", "bielle-table b.h5 --quantity q --csv -", "```", "```text", "1", "```")
        self.assertEqual((one.name, one.kind, one.output, one.written, one.ended, one.quantities), ("a.yaml", "model", "b.h5", 0, 2, ["--quantity", "q"]))
        for line in ("bielle-mechanism other.yaml", "bielle-mechanism a.yaml --check", "bielle-mechanism --keys hinge", "ls", "bielle-reduce"):
            self.assertEqual(self.chosen("```sh", line, "```"), [], line)
        self.assertEqual(self.chosen("```", "bielle-mechanism a.yaml", "```"), [])
        self.assertEqual([each.output for each in self.chosen("```sh", "bielle-mechanism a.yaml", "bielle-mechanism a.yaml -o second.h5", "```")], ["a.h5"])

    def test_comments_choose(self):
        one, = self.chosen("<!-- plot: q, r -->", "<!-- picture: --view=-y --hide 'a b' -->", "```sh", "bielle-mechanism a.yaml", "```", "<!-- keys: hinge -->")
        self.assertEqual(one.chosen, {"plot": ["q,", "r"], "picture": ["--view=-y", "--hide", "a b"]})
        with self.assertRaisesRegex(InputError, r"page.md:1: no model that the page runs stands before '<!-- plot: q -->'"):
            examples_of(self.page("<!-- plot: q -->\n"))
        shown, = self.chosen("```", "<!-- plot: shown -->", "```", "```sh", "bielle-mechanism a.yaml", "```", "<!-- plot: r -->")
        self.assertEqual(shown.chosen, {"plot": ["r"]}, "a comment in a block is for the reader")

    def test_pages_of_the_site_can_be_read(self):
        every = {page: os.path.join(REPOSITORY, page) for part in site.pages_of(REPOSITORY).values() for page in part}
        self.assertGreater(len(runnable(every)), 40)

    def test_pages_of_getting_started_are_run_together(self):
        started = "mechanism/manual/getting_started"
        found = {f"{started}/{name}": os.path.join(REPOSITORY, started, name) for name in sorted(os.listdir(os.path.join(REPOSITORY, started)))}
        found["page.md"] = self.page(PENDULUM)
        groups = runnable(found)
        self.assertEqual(groups[1:], [["page.md"]])
        self.assertEqual(groups[0][:2], [f"{started}/1_pendulum.md", f"{started}/2_four_bar.md"])


class Making(Pages):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.enterClassContext(unittest.mock.patch.object(gathering, "TOOLS", cls.enterClassContext(quick_tools())))

    def test_a_page_has_its_machine_and_its_curve(self):
        self.page(PENDULUM)
        found = self.gathered("page.md")
        self.assertEqual([(each.name, each.after) for each in found.pictures["page.md"]], [("page_pendulum.png", 0), ("page_pendulum_plot.svg", 2)])
        self.assertRegex(found.pictures["page.md"][0].alt, r"^a pendulum: the machine of pendulum.yaml, at t = 0\.\d+ s, over its first position in grey$")
        self.assertEqual(found.pictures["page.md"][1].alt, "a pendulum: height over time")
        with Image.open(os.path.join(found.folders["page.md"], "page_pendulum.png")) as image:
            pixels = np.asarray(image.convert("RGB")).astype(int)
        blue = pixels[..., 2] - pixels[..., 0] > 40  # the bob and its arm
        grey = (np.ptp(pixels, axis=2) < 12) & (pixels.max(axis=2) > 150) & (pixels.max(axis=2) < 245)  # its first position
        grey[:40] = False
        self.assertGreater(blue.sum(), 1000)
        self.assertGreater(grey.sum(), 1000)
        columns = [np.flatnonzero(each.any(axis=0)).mean() for each in (blue, grey)]
        self.assertGreater(columns[1] - columns[0], 100, "it has swung to the left of its first position")
        figure = xml.dom.minidom.parse(os.path.join(found.folders["page.md"], "page_pendulum_plot.svg"))
        self.assertGreater(len(max((path.getAttribute("d") for path in figure.getElementsByTagName("path")), key=len).split()), 200, "all rows are drawn")

    def test_pictures_are_made_once(self):
        self.page(PENDULUM)
        first = self.gathered("page.md")
        self.assertEqual((first.made, first.kept, self.said), (1, 0, ["page.md"]))
        self.page("More words.\n\n" + PENDULUM + "\nWords at the end.\n")
        second = self.gathered("page.md")
        self.assertEqual((second.made, second.kept, self.said), (0, 1, []))
        self.assertEqual(second.pictures, first.pictures)
        self.page(PENDULUM.replace("COMMENT", "<!-- plot: none -->"))
        third = self.gathered("page.md")
        self.assertEqual((third.made, [each.name for each in third.pictures["page.md"]]), (1, ["page_pendulum.png"]))
        self.assertEqual(os.listdir(self.path("kept")), [os.path.basename(third.folders["page.md"])], "those of the old page are removed")

    def test_chosen_pictures(self):
        self.page(PENDULUM.replace("COMMENT", "<!-- picture: none -->\n<!-- plot: --quantity pivot.angle --against height -->"), "one.md")
        self.page(PENDULUM.replace("COMMENT", "<!-- picture: --view=x --from 0.1 --to 0.1 -->\n<!-- plot: pivot.angle, height -->"), "two.md")
        found = self.gathered("one.md", "two.md")
        self.assertEqual([(each.name, each.alt) for each in found.pictures["one.md"]], [("one_pendulum_plot.svg", "a pendulum: pivot.angle over height")])
        self.assertEqual([each.alt for each in found.pictures["two.md"]],
                         ["a pendulum: the machine of pendulum.yaml, as chosen", "a pendulum: pivot.angle, height over time"])

    def test_faults_name_the_page(self):
        for wrong, sentence in ((PENDULUM.replace("COMMENT", "<!-- plot: pivot.angel -->"), "page.md: .*pivot.angel"),
                                (PENDULUM.replace("COMMENT", "<!-- picture: --hide rigid_body --hide joint --hide node --hide hinge -->"), "page.md: .*leaves nothing"),
                                (PENDULUM.replace("0.6,-0.26125", "0.6,-0.29"), "page.md:.*does not print"),
                                (PENDULUM.replace("type: hinge", "type: hnige"), "page.md:.*did you mean 'hinge'")):
            self.page(wrong)
            with self.assertRaisesRegex(InputError, sentence):
                self.gathered("page.md")
            self.assertEqual(os.listdir(self.path("kept")), [], "nothing is kept of a page that failed")

    def test_a_mode_a_body_and_a_constant(self):
        bar = "bar.geo"
        shutil.copy(os.path.join(REPOSITORY, "meshes", bar), self.path(bar))
        self.page("```sh\ncp \"$BIELLE/meshes/bar.geo\" .\n```\n```yaml\n# bar.yaml\nbody: bar\ngeometry: bar.geo\nmesh: {size: 0.1}\nmaterials: {s: {young: 210e9, poisson: 0.3, density: 7800}}\n"
                  "regions: {bar: s}\ninterfaces: {root: {surface: root}}\nmodes: {count: 4}\n```\n```sh\nbielle-reduce bar.yaml\n```\n", "body.md")
        swing = PENDULUM.replace("dynamic, duration: 0.6, step: 0.002", "eigen, count: 1").replace("bielle-table pendulum.h5 --quantity height --csv -\n", "")
        self.page(swing[:swing.index("```text")].replace("COMMENT", ""), "mode.md")
        rest = PENDULUM.replace("gravity: [0, 0, -9.81]\n", "").replace("COMMENT", "")
        self.page(rest[:rest.index("```text")], "rest.md")
        found = self.gathered("body.md", "mode.md", "rest.md").pictures
        self.assertEqual([each.alt for each in found["body.md"]], ["The body of bar.yaml: its first vibration without supports"])
        self.assertEqual([each.alt for each in found["mode.md"]], ["a pendulum: the machine of pendulum.yaml, mode 1 over its state"])
        self.assertEqual([each.name for each in found["rest.md"]], ["rest_pendulum.png"], "a quantity that does not change has no curve")

    def test_an_empty_picture_is_refused(self):
        image = np.full((500, 800, 3), 255, np.uint8)
        image[:30] = 0  # the title alone
        Image.fromarray(image).save(self.path("empty.png"))
        with self.assertRaisesRegex(InputError, "shows nothing: 0 of its pixels are drawn"):
            check_ink(self.path("empty.png"))
        image[200:230, 300:330] = 90
        Image.fromarray(image).save(self.path("full.png"))
        check_ink(self.path("full.png"))


class Site(Pages):
    def test_pictures_follow_their_blocks(self):
        text = "a\n```yaml\n# m.yaml\n```\nb\n```sh\nrun\n```\nc\n"
        pictures = [Picture("m.png", "one [two] `three`", 0), Picture("m_plot.svg", "curve", 1), Picture("own.png", "", None)]
        self.assertEqual(site._with_pictures(text, pictures),  # pylint: disable=protected-access
                         "a\n```yaml\n# m.yaml\n```\n\n![one  two   three ](m.png)\n\nb\n```sh\nrun\n```\n\n![curve](m_plot.svg)\n\nc\n")
        self.assertTrue(site._with_pictures("<!-- pictures -->\n" + text, pictures).startswith("![one"))  # pylint: disable=protected-access

    def test_pages_of_examples(self):
        found = write_pages(REPOSITORY, self.folder)
        self.assertGreater(len(found), 20)
        self.assertEqual({name[:-5] for name in os.listdir(os.path.join(REPOSITORY, "mechanism", "examples")) if name.endswith(".yaml")},
                         {os.path.basename(page)[:-3] for page in found})
        for page, path in found.items():
            self.assertEqual(len([each for each in examples_of(path) if each.kind == "model"]), 1, page)
        with open(found["mechanism/examples/slider_crank.md"], encoding="utf-8") as file:
            text = file.read()
        self.assertIn('bielle-reduce "$BIELLE/meshes/conrod.yaml" -o conrod.h5', text)
        with open(found["mechanism/examples/robot_arm.md"], encoding="utf-8") as file:
            self.assertIn("\nbielle-mechanism robot_arm.yaml\n", file.read())
        self.assertTrue(page_of(REPOSITORY, "no_title.yaml", "nodes: {}\n").startswith("# No title\n"))

    def shown(self):
        """Returns {page: [(page whose picture it shows, line)]} of the site. `pages` with models are {page: path}"""
        os.makedirs(self.path("pages"), exist_ok=True)
        every = {page: os.path.join(REPOSITORY, page) for part in site.pages_of(REPOSITORY).values() for page in part}
        every.update(write_pages(REPOSITORY, self.path("pages")))
        found = {}
        for page, path in every.items():
            with open(path, encoding="utf-8") as file:
                found[page] = site.shown_pages(BLOCK.sub("", file.read()), page)
        return found, every

    def test_pages_whose_pictures_are_shown_have_models(self):
        found, every = self.shown()
        self.assertGreater(sum(map(len, found.values())), 15)
        for page, others in found.items():
            for other, line in others:
                with self.subTest(f"{page}:{line}"):
                    self.assertIn(other, every)
                    self.assertNotEqual(examples_of(every[other]), [])

    def test_a_page_shows_the_picture_of_another(self):
        pictures = [Picture("own.png", "", None), Picture("m.png", "a [machine]", 0), Picture("m_plot.svg", "a curve", 1)]
        gathered = Gathered({"a/b/other.md": pictures, "a/bare.md": pictures[:1]}, {})

        def written(comment):
            return site.SHOWS.sub(lambda match: site._shown(match, "a/c/page.md", gathered), f"x\n{comment}\ny\n")  # pylint: disable=protected-access
        self.assertEqual(written("<!-- shows: ../b/other.md -->"), "x\n[![a  machine ](../b/m.png)](../b/other.md)\ny\n")
        self.assertEqual(written("<!-- shows: ../b/other.md machine -->"), written("<!-- shows: ../b/other.md -->"))
        self.assertEqual(written("<!-- shows: ../b/other.md curve -->"), "x\n[![a curve](../b/m_plot.svg)](../b/other.md)\ny\n")
        for comment, said in (("<!-- shows: ../bare.md -->", "the page 'a/bare.md' has no machine"), ("<!-- shows: none.md curve -->", "the page 'a/c/none.md' has no curve")):
            with self.assertRaisesRegex(InputError, f"a/c/page.md: '{comment}': {said}"):
                written(comment)

    def test_sources_have_the_pictures(self):
        os.mkdir(self.path("kept"))
        for name in ("p.png", "p_plot.svg"):
            self.write(f"kept/{name}", "x")
        page = "mechanism/manual/reference/joints/bearing.md"
        found, every = self.shown()
        drawn = {page, *(other for others in found.values() for other, _ in others)}
        gathered = Gathered({each: [Picture("p.png", "alt", 0), Picture("p_plot.svg", "alt", 0)] for each in drawn}, {each: self.path("kept") for each in drawn})
        own = {each: path for each, path in every.items() if each.startswith("mechanism/examples/")}
        site.write_sources(REPOSITORY, self.path("sources"), gathered, own)
        for shows in filter(found.get, found):
            with open(os.path.join(self.path("sources"), shows), encoding="utf-8") as file:
                text = file.read()
            self.assertNotIn("<!-- shows", text)
            for place in re.findall(r"\[!\[alt\]\((\S+)\)\]", text):
                self.assertTrue(os.path.isfile(os.path.join(self.path("sources"), os.path.dirname(shows), place)), f"{shows}: {place}")
        folder = os.path.dirname(os.path.join(self.path("sources"), page))
        self.assertTrue(os.path.isfile(os.path.join(folder, "p.png")))
        with open(os.path.join(self.path("sources"), page), encoding="utf-8") as file:
            self.assertEqual(file.read().count("![alt](p.png)"), 1)


if __name__ == "__main__":
    unittest.main()
