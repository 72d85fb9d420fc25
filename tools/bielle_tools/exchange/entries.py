"""Matrices out of lists of entries, of which a file may hold one triangle or both."""

import numpy as np
import scipy.sparse

from ..messages import InputError, counted
from .matrix_set import mirrored, sparse

LARGEST_DENSE = 30000  # rows of a matrix whose entries are all written


def matrix_of(path, rows, columns, values, size, names=None):
    """The matrix with these entries, counted from 0 (scipy.sparse). If each pair of row and column is there on one side of the
    diagonal alone, the matrix is symmetric.

    @param names: (size, 2) node and component of each row, for the message @raises InputError for an entry that stands twice"""
    keys = np.sort(np.asarray(rows, np.int64) * size + columns)
    twice = keys[1:][np.diff(keys) == 0]
    if len(twice):
        row, column = (int(each) for each in divmod(twice[0], size))
        told = f"row {row + 1}, column {column + 1}" if names is None else " and ".join(
            f"node {names[k][0]} component {names[k][1]}" for k in (row, column))
        raise InputError(f"'{path}': the entry of {told} stands twice")
    matrix = sparse(scipy.sparse.coo_matrix((values, (rows, columns)), shape=(size, size)))
    low, high = np.minimum(rows, columns).astype(np.int64), np.maximum(rows, columns)
    pairs = (low * size + high)[low != high]
    return mirrored(matrix) if len(np.unique(pairs)) == len(pairs) else matrix


def packed_matrix(path, values, size, what):
    """The symmetric matrix whose lower triangle is listed row by row, which is the upper one column by column.

    @raises InputError if the count of numbers is another one; what: noun for the message
    """
    wanted = size * (size + 1) // 2
    if len(values) != wanted:
        raise InputError(f"'{path}': {what} has {counted(len(values), 'number')}, but a triangle of {size} rows has "
                         f"{wanted}")
    full = np.zeros((size, size))
    full[np.tril_indices(size)] = values
    return sparse(full + np.tril(full, -1).T)


def packed_triangle(matrix):
    """The lower triangle row by row, of a symmetric matrix. @raises InputError if the matrix is too large to be written in full"""
    if matrix.shape[0] > LARGEST_DENSE:
        raise InputError(f"a matrix of {matrix.shape[0]} rows is too large for a file that holds all entries")
    full = matrix.toarray()
    return [full[row, :row + 1] for row in range(len(full))]


def symmetric_part(matrix):
    """(A + A^T) / 2 of an array."""
    return (matrix + matrix.T) / 2


def check_symmetric(matrices):
    """@raises InputError if a matrix of a MatrixSet is not symmetric, for formats that hold one triangle"""
    for name, matrix in matrices.matrices().items():
        difference = abs(matrix - matrix.T)
        if difference.nnz and difference.max() > 1e-9 * abs(matrix).max():
            raise InputError(f"the {name} is not symmetric: entries of its triangles differ by {difference.max():.3g}")
