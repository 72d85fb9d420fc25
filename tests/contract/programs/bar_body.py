"""Base class of tests that reduce a bar. Each test has a folder with the geometry."""

from command import CommandTest


class BarTest(CommandTest):
    program = "bielle-reduce"
    geometry = ""  # text of bar.geo

    def setUp(self):
        super().setUp()
        self.write("bar.geo", self.geometry)

    def reduce(self, body):
        """Runs the program, which must succeed."""
        self.write("body.yaml", body)
        done = self.run_program("body.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done
