"""Vectors, turns and inertias in ball arithmetic: lists of `flint.arb`."""

from flint import arb

Vector = list[arb]
Matrix = list[list[arb]]


def dot(a: Vector, b: Vector) -> arb:
    return sum((x * y for x, y in zip(a, b, strict=True)), arb(0))


def transposed(A: Matrix) -> Matrix:
    return [list(column) for column in zip(*A, strict=True)]


def times(A: Matrix, B: Matrix) -> Matrix:
    return [[dot(row, column) for column in transposed(B)] for row in A]


def plus(A: Matrix, B: Matrix) -> Matrix:
    return [[a + b for a, b in zip(x, y, strict=True)] for x, y in zip(A, B, strict=True)]


def cross(a: Vector) -> Matrix:
    x, y, z = a
    return [[arb(0), -z, y], [z, arb(0), -x], [-y, x, arb(0)]]


def turn_x(angle: arb) -> Matrix:
    s, c, one, zero = angle.sin(), angle.cos(), arb(1), arb(0)
    return [[one, zero, zero], [zero, c, -s], [zero, s, c]]


def turn_z(angle: arb) -> Matrix:
    s, c, one, zero = angle.sin(), angle.cos(), arb(1), arb(0)
    return [[c, -s, zero], [s, c, zero], [zero, zero, one]]


def moved(origin: Vector, R: Matrix, offset: Vector) -> Vector:
    """origin + R offset."""
    return [p + dot(row, offset) for p, row in zip(origin, R, strict=True)]


def joint_space(parents: list[int], axes: list[Vector | None], inertias: list[Matrix]) -> Matrix:
    """H_jk = s_j . I_k s_k over the bodies with an axis, from links in the world's frame, parents first."""
    composites = [[row[:] for row in I] for I in inertias]
    for i in reversed(range(len(parents))):
        if parents[i] >= 0:
            composites[parents[i]] = plus(composites[parents[i]], composites[i])
    place = {i: d for d, i in enumerate(i for i, axis in enumerate(axes) if axis is not None)}
    H = [[arb(0)] * len(place) for _ in place]
    for k in place:
        momentum = [dot(row, axes[k]) for row in composites[k]]
        j = k
        while j >= 0:
            if j in place:
                H[place[j]][place[k]] = H[place[k]][place[j]] = dot(axes[j], momentum)
            j = parents[j]
    return H


def spatial_inertia(m: arb, com: Vector, I: Matrix) -> Matrix:
    """About the world's origin, [angular; linear]: [I - m c x c x, m c x; -m c x, m]."""
    C = cross(com)
    CC = times(C, C)
    upper = [[I[i][j] - m * CC[i][j] for j in range(3)] + [m * C[i][j] for j in range(3)] for i in range(3)]
    lower = [[-m * C[i][j] for j in range(3)] + [m if i == j else arb(0) for j in range(3)] for i in range(3)]
    return upper + lower
