"""Quantities by name: resolution, columns, curves, peaks, spectra, cycles, tables."""
