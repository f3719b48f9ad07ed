"""LAPACK by numpy as a contestant of `peers race`: eigenvalues only, all states of a robot in one call.

    python oracle/lapack_peer.py ROBOT.robot ..

Answers `time ROBOT eigenvalues` and `value ROBOT eigenvalues`; the matrices stand in ROBOT.f64 beside each file.
The caller limits the threads: OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1.
"""

import sys
import time
from pathlib import Path

import numpy

LONG_ENOUGH = 2e-3  # s


def read(path: Path) -> numpy.ndarray:
    _, _, nv, _, samples, *_ = path.read_text(encoding="utf-8").split(maxsplit=5)
    return numpy.fromfile(path.with_suffix(".f64")).reshape(int(samples), int(nv), int(nv))


def seconds(matrices: numpy.ndarray, at_least: float) -> float:
    start, calls = time.perf_counter(), 0
    while time.perf_counter() - start < at_least:
        numpy.linalg.eigvalsh(matrices)
        calls += len(matrices)
    return (time.perf_counter() - start) / calls


def main() -> None:
    robots = {path.stem: read(path) for path in map(Path, sys.argv[1:])}
    for line in sys.stdin:
        question, robot, quantity = line.split()
        if quantity != "eigenvalues":
            answer = "none"
        elif question == "value":
            values = numpy.linalg.eigvalsh(robots[robot][0])
            answer = f"{values[0]:.17g} {values[-1]:.17g}"
        else:
            seconds(robots[robot], LONG_ENOUGH / 2)  # memory near, the processor awake
            answer = f"{seconds(robots[robot], LONG_ENOUGH):e}"
        print(answer, flush=True)


if __name__ == "__main__":
    main()
