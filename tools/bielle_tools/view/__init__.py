"""The machine in one HTML file: motion, stresses, plots, modes, in any browser without a server."""

from .page import build_page

__all__ = ["build_page"]
