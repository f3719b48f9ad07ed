"""H by Pinocchio and its eigenvalues by LAPACK, along the motions that `peers matrices` wrote: one line a number.

The caller limits the threads: OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1.
"""

import sys
import time
from pathlib import Path

import numpy
import pinocchio

# At most so many rows, and so many seconds, a robot.
ROWS = 100
SECONDS = 1.5


def chain(n: int, skew: float) -> pinocchio.Model:
    """hydra(n, 1, skew, 1): thin tubes of 1 kg and 1 m, each axis turned against the one before about the link."""
    model = pinocchio.Model()
    turn = pinocchio.SE3(pinocchio.AngleAxis(skew, numpy.array([1.0, 0.0, 0.0])).matrix(), numpy.array([1.0, 0.0, 0.0]))
    link = pinocchio.Inertia(1.0, numpy.array([0.5, 0.0, 0.0]), numpy.diag([0.0025, 1.015 / 12, 1.015 / 12]))
    parent = 0
    for k in range(n):
        placement = turn if k else pinocchio.SE3.Identity()
        parent = model.addJoint(parent, pinocchio.JointModelRZ(), placement, f"joint_{k}")
        model.appendBodyToJoint(parent, link, pinocchio.SE3.Identity())
    return model


def main() -> None:
    for path in sorted(Path(sys.argv[1]).glob("swing-*.f64")):
        name = path.stem.removeprefix("swing-")
        skew, n = float(name.rsplit("-", 1)[0]), int(name.rsplit("-", 1)[1])
        rows = numpy.fromfile(path).reshape(-1, n)
        model = chain(n, skew)
        data = model.createData()
        times, begin = [], time.perf_counter()
        for q in rows[:ROWS]:
            start = time.perf_counter()
            pinocchio.crba(model, data, q)
            numpy.linalg.eigvalsh(data.M, UPLO="U")
            times.append(time.perf_counter() - start)
            if time.perf_counter() - begin > SECONDS:
                break
        print(f"pinocchio {name}\t{numpy.median(times):e}")
        pinocchio.crba(model, data, rows[-1])
        values = numpy.linalg.eigvalsh(data.M, UPLO="U")
        least, most = map(float, path.with_suffix(".ends").read_text().split())
        # LAPACK knows λmin to about n ε λmax.
        print(f"error track {name}\t{max(abs(values[0] - least), abs(values[-1] - most)) / most:e}")


if __name__ == "__main__":
    main()
