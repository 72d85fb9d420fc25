"""Solid meshes: cells of all types, their faces and integrals, checks, MSH files."""
