"""Ends of a spectrum in ball arithmetic: found by bisection, proved by counting.

A symmetric matrix is a list of rows of `flint.arb`. The number of eigenvalues below s is the number of negative pivots of
H - s (Sylvester); every sign is proved, or the precision was too low and that is an error.
"""

from flint import arb

DIGITS = 25  # to which an end is proved


def count_below(H: list[list[arb]], s: arb) -> int:
    """Number of eigenvalues below s."""
    n = len(H)
    A = [[H[i][j] - s if i == j else H[i][j] for j in range(i + 1)] for i in range(n)]
    negative = 0
    for k in reversed(range(n)):
        pivot = A[k][k]
        if not (pivot > 0 or pivot < 0):
            raise ArithmeticError("a pivot cannot be told from zero: more bits are needed")
        negative += int(pivot < 0)
        for i in range(k):
            ratio = A[k][i] / pivot
            if ratio != 0:
                for j in range(i + 1):
                    A[i][j] -= ratio * A[k][j]
    return negative


def ends(H: list[list[arb]]) -> tuple[arb, arb]:
    """Smallest and largest eigenvalue of a positive definite matrix."""
    n = len(H)
    trace = sum((H[i][i] for i in range(n)), arb(0))
    least = min((H[i][i] for i in range(n)), key=lambda x: x.mid())
    return find(H, 0, least.mid() * 2), find(H, n - 1, trace.mid() * 2)


def find(H: list[list[arb]], index: int, above: arb) -> arb:
    """Eigenvalue `index`, 0 the smallest, which lies between zero and `above`."""
    hi, lo = above, above
    while count_below(H, lo) > index:
        hi, lo = lo, lo / 1024
    step = arb(10) ** -DIGITS
    while (hi / lo - 1).mid() > step:
        middle = (hi * lo).sqrt().mid()
        if count_below(H, middle) > index:
            hi = middle
        else:
            lo = middle
    return ((hi + lo) / 2).mid()
