"""Results files: rows, columns, rotations, modes, state spaces."""

from .results_file import Results  # noqa: F401
