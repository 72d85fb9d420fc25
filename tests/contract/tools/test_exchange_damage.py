"""Tests of damaged files of matrices: files with flipped, removed or repeated bytes are read, or refused with one
sentence."""

import os
import random
import unittest
import warnings

from exchange_bodies import Exchange, cloud_body
from bielle_tools.exchange import formats
from bielle_tools.messages import InputError

STI = "".join(f"{i} {j} {1.5 * i - j if i != j else 10 + i}\n" for j in range(1, 7) for i in range(1, j + 1))
# {name of the format: file that is read, options of reading}. Files are those of a writer, or texts.
WRITTEN = {"abaqus": ("a.mtx", {}), "matrix_input": ("a_STIF1.mtx", {}), "calculix": ("a.mtx", {}), "matrix_market": ("a_stiffness.mtx", {}),
           "npz": ("a.npz", {}), "exudyn": ("a.npz", {"interfaces": [1, 2, 3]}), "mbdyn": ("a.fem", {"interfaces": [3]}), "simscape": ("a.mat", {}),
           "fedem": ("a_S.fmx", {})}
COUNT = int(os.environ.get("BIELLE_DAMAGES", "20"))  # number of damages per file


class Damage(Exchange):
    def damaged(self, content, rng):
        """Flips some bytes, cuts off the end, or repeats a part."""
        data = bytearray(content)
        kind = rng.randrange(3)
        if kind == 0:
            for _ in range(rng.randrange(1, 4)):
                data[rng.randrange(len(data))] = rng.randrange(256)
        elif kind == 1:
            del data[rng.randrange(len(data)):]
        else:
            begin = rng.randrange(len(data))
            data[begin:begin] = data[begin:begin + rng.randrange(1, 200)]
        return bytes(data)

    def attack(self, name, path, files, **given):
        rng = random.Random(60)
        refused = 0
        for target in files:
            with open(target, "rb") as file:
                whole = file.read()
            for step in range(COUNT):
                with open(target, "wb") as file:
                    file.write(self.damaged(whole, rng))
                try:
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore")
                        self.read(name, path, **given)
                except InputError as error:
                    refused += 1
                    self.assertNotIn("\n", str(error))
                except Exception as error:
                    raise AssertionError(f"{name}, {target}, damage {step}: {type(error).__name__}: {error}") from error
            with open(target, "wb") as file:
                file.write(whole)
        self.assertGreater(refused, COUNT // 4)

    def test_written_files(self):
        for name, (read, given) in WRITTEN.items():
            with self.subTest(name):
                self.setUp()
                body = cloud_body(scalars=3, points=6, damping=False)
                paths = formats.module_of(name).write(body, self.path("a" + formats.FORMATS[name][1][0].replace(".sti", ".mtx")), self.options())
                self.attack(name, self.path(read), [each for each in paths if not each.endswith(".m")], **given)

    def test_files_of_calculix(self):
        self.write("job.inp", "*NODE\n7, 1, 2, 3\n5, 0, 0, 1\n*ELEMENT, TYPE=S3, ELSET=E\n")
        self.write("job.mas", "".join(f"{k} {k} 1\n" for k in range(1, 7)))
        for dof in ("5.1\n5.2\n5.3\n7.1\n7.2\n7.3\n", "5.1\n5.2\n5.3\n5.1\n5.2\n5.3\n"):
            self.write("job.frd", "    1C\n    2C                             2                                     1\n"
                       " -1        14 0.00000E+00 0.00000E+00-5.00000E-02\n -1        16 0.00000E+00 0.00000E+00 5.00000E-02\n -3\n 9999\n")
            self.write("job.dof", dof)
            self.attack("calculix", self.write("job.sti", STI), [self.path("job" + each) for each in (".sti", ".mas", ".dof", ".inp", ".frd")])

    def test_empty_files_and_folders(self):
        for name, (_, endings) in formats.FORMATS.items():
            if name in ("superelement", "matrices") or name not in (*WRITTEN, "calculix"):
                continue
            for path in (self.write("empty" + endings[0], ""), self.path("missing" + endings[0]), self.folder):
                with self.subTest(f"{name} {path}"), self.assertRaises(InputError):
                    self.read(name, path)


if __name__ == "__main__":
    unittest.main()
