"""Base class of tests with a reduction of the bar in meshes/, and with runs of models of it."""

import os
import shutil
import subprocess

from box_mesh import REPOSITORY, InFolder

PROGRAMS = os.environ["BIELLE_PROGRAMS"]


class ReducedBar(InFolder):
    def reduce_bar(self, body):
        """Reduces the bar by the text of a body file, as bar.h5 in the folder."""
        shutil.copy(os.path.join(REPOSITORY, "meshes", "bar.geo"), self.folder)
        self.write("bar.yaml", body)
        subprocess.run([os.path.join(PROGRAMS, "bielle-reduce"), "bar.yaml", "-o", "bar.h5"], cwd=self.folder, check=True,
                       capture_output=True, timeout=120)

    def run_bar(self, model):
        """Runs the text of a model, with the results in run.h5."""
        self.write("model.yaml", model)
        subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "model.yaml", "-o", "run.h5", "--quiet"],
                       cwd=self.folder, check=True, timeout=60)
