"""Finds modules of Eigen that a source uses but does not include, directly or through its own headers.

Such a source compiles with precompiled headers, and without them as well: Eigen/Core declares the members, and only the
linker reports missing definitions.
"""

import os
import re

from includes import INCLUDE, sources

# Eigen/LU also defines `inverse()`, but arrays, diagonals and rotations do so as well, and the text does not
# distinguish them.
USES = {
    "Geometry": re.compile(r"\.cross\(|\.unitOrthogonal\(|\bEigen::(Quaterniond|AngleAxisd|Isometry3d)\b"),
    "LU": re.compile(r"\.determinant\(|[pP]artialPivLu|[fF]ullPivLu|\.lu\(\)"),
    "Cholesky": re.compile(r"\bEigen::LD?LT<|\.ld?lt\(\)"),
    "QR": re.compile(r"HouseholderQR|[hH]ouseholderQr\(|[pP]ivHouseholderQr\(|CompleteOrthogonalDecomposition"),
    "SVD": re.compile(r"JacobiSVD|BDCSVD|jacobiSvd|bdcSvd"),
    "Eigenvalues": re.compile(r"\bEigen::\w*EigenSolver<"),
    "SparseCore": re.compile(r"\bEigen::SparseMatrix<"),
}
# Modules that a header of Eigen also includes.
BRINGS = {"Dense": {"Geometry", "LU", "Cholesky", "QR", "SVD", "Eigenvalues"},
          "SVD": {"QR"}, "Eigenvalues": {"Cholesky", "LU", "QR", "Geometry"}, "QR": {"Cholesky"}, "Geometry": {"SVD", "LU", "QR"},
          "SparseCholesky": {"SparseCore"}, "SparseLU": {"SparseCore"}, "SparseQR": {"SparseCore"},
          "CholmodSupport": {"SparseCore"}, "KLUSupport": {"SparseCore"}, "Sparse": {"SparseCore"}}
MODULE = re.compile(r"^\s*#\s*include\s*<Eigen/(\w+)>", re.M)
OWN = re.compile(INCLUDE.pattern, re.M)


def modules_used(text):
    return {module for module, use in USES.items() if use.search(text)}


def modules_included(text):
    included = set(MODULE.findall(text))
    while True:
        more = included.union(*(BRINGS.get(module, set()) for module in included))
        if more == included:
            return included
        included = more


def missing_modules(root):
    """Returns all errors, as `file: Eigen/Module`."""
    texts, reached = {}, {}

    def text_of(path):
        if path not in texts:
            with open(os.path.join(root, path), encoding="utf-8") as file:
                texts[path] = file.read()
        return texts[path]

    def modules_of(path):
        if path not in reached:
            reached[path] = set()  # ends circular includes
            reached[path] = modules_included(text_of(path)).union(*(modules_of(own) for own in OWN.findall(text_of(path))))
        return reached[path]

    return [f"{path}: Eigen/{module}" for path in sources(root)
            for module in sorted(modules_used(text_of(path)) - modules_of(path))]
