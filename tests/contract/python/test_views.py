"""Tests of the page of bielle-view from Python: run.show() and bielle.view."""

import html
import importlib.util
import os
import unittest

import bielle

from samples import PENDULUM, InFolder

LIBRARIES = ("/usr/share/javascript/three/three.min.js", "/usr/share/javascript/chart.js/chart.min.js")
MISSING = [path for path in LIBRARIES if not os.path.isfile(path)]


@unittest.skipIf(MISSING, f"{' and '.join(MISSING)} missing (Debian packages libjs-three, libjs-chart.js)")
class Views(InFolder):
    def test_a_run_is_shown_and_saved(self):
        run = bielle.run(bielle.read(PENDULUM), self.path("run.h5"))
        shown = run.show(height=321)
        self.assertIsInstance(shown, bielle.View)
        cell = shown._repr_html_()
        self.assertTrue(cell.startswith("<iframe srcdoc=\"&lt;!DOCTYPE html&gt;") and cell.endswith("></iframe>"), cell[:60])
        self.assertIn("height: 321px", cell)
        self.assertEqual(cell.count("<"), 2)  # the page is an escaped attribute, so that only two tags remain
        with open(shown.save(self.path("machine.html")), encoding="utf-8") as file:
            self.assertEqual(file.read(), shown.page)

    @unittest.skipUnless(importlib.util.find_spec("IPython"), "IPython is not installed (Debian package python3-ipython)")
    def test_a_notebook_takes_the_page_of_a_cell(self):
        from IPython.core.formatters import DisplayFormatter
        shown = bielle.run(bielle.read(PENDULUM), self.path("run.h5")).show()
        data, _ = DisplayFormatter().format(shown)
        self.assertEqual(data["text/html"], shown._repr_html_())
        self.assertEqual(data["text/plain"], repr(shown))
        self.assertEqual(html.unescape(data["text/html"].partition('srcdoc="')[2].rpartition('" style=')[0]), shown.page)

    def test_files_are_shown_over_each_other(self):
        paths = [self.path(name) for name in ("a.h5", "b.h5")]
        for path in paths:
            bielle.run(bielle.read(PENDULUM), path)
        self.assertGreater(len(bielle.view(*paths).page), len(bielle.view(paths[0]).page))

    def test_what_cannot_be_shown(self):
        with self.assertRaisesRegex(bielle.Error, "wrote no results file"):
            bielle.run(bielle.read(PENDULUM)).show()
        with self.assertRaisesRegex(bielle.InputError, "does not exist"):
            bielle.view(self.path("absent.h5"))
        run = bielle.run(bielle.read(PENDULUM), self.path("run.h5"))
        for wrong in ({"frames": -1}, {"frames": 0}, {"height": 0}):
            with self.assertRaisesRegex(bielle.InputError, f"{next(iter(wrong))}: expected a number from 1 on, found"):
                run.show(**wrong)


if __name__ == "__main__":
    unittest.main()
