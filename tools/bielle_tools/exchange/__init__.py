"""Matrices of bodies in the files of other programs: one model of them (`matrix_set`), and a module for each format."""
