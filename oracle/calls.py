"""What calls cost from Python, for `cargo xtask python-bench`: calls.py SMALL BIG COUNT, as the example `calls` of eigenbody-formats.

One line a figure: name, tab, seconds.
"""

from __future__ import annotations

import sys
import time
import timeit

import numpy as np
import pinocchio

import eigenbody


def single(path: str) -> None:
    robot, theirs = eigenbody.Model(path), pinocchio.buildModelFromUrdf(path)
    data, q = theirs.createData(), robot.random(1)
    v = np.ones(robot.nv)
    out = np.empty((robot.nv, robot.nv))
    calls = {
        "python single": lambda: robot.mass_matrix(q),
        "python single out": lambda: robot.mass_matrix(q, out=out),
        "pinocchio single": lambda: pinocchio.crba(theirs, data, q),
        "python rnea": lambda: robot.rnea(q, v, v),
        "pinocchio rnea": lambda: pinocchio.rnea(theirs, data, q, v, v),
        "python aba": lambda: robot.aba(q, v, v),
        "pinocchio aba": lambda: pinocchio.aba(theirs, data, q, v, v),
    }
    best = dict.fromkeys(calls, np.inf)
    # In turn, so that whatever else goes on hits all alike.
    for _ in range(20):
        for name, call in calls.items():
            best[name] = min(best[name], timeit.timeit(call, number=20_000) / 20_000)
    for name, seconds in best.items():
        print(f"{name}\t{seconds:e}")


def batch(path: str, count: int) -> None:
    robot = eigenbody.Model(path, base="floating")
    q = robot.random(1, count)
    out = np.ones((count, robot.nv, robot.nv))
    filled = fresh = np.inf
    for _ in range(3):
        start = time.perf_counter()
        robot.mass_matrix(q, out=out)
        filled = min(filled, time.perf_counter() - start)
    del out
    for _ in range(3):
        start = time.perf_counter()
        H = robot.mass_matrix(q)
        fresh = min(fresh, time.perf_counter() - start)
        del H
    print(f"python batch\t{filled:e}\npython batch new\t{fresh:e}")


if __name__ == "__main__":
    single(sys.argv[1])
    batch(sys.argv[2], int(sys.argv[3]))
