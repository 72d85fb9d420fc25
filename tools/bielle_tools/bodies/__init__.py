"""Superelements: mesh and recovery, loads on the mesh and their case for CalculiX, radiated power."""
