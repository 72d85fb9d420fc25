"""Describes and runs the problems of the verification report; a problem file imports everything from here."""

from .problem import Problem, Quantity, Study
from .references import row, vector

__all__ = ["Problem", "Quantity", "Study", "row", "vector"]
