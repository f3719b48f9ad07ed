"""H by Pinocchio and its eigenvalues by LAPACK along the motions that `peers matrices` wrote: one line a number.

The caller limits the threads: OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1.
"""

import sys
import time
from pathlib import Path

import numpy
import pinocchio

# Beyond, Pinocchio's Data does not fit: it has room for n³ second derivatives. H is then made here, and only LAPACK is timed.
LARGEST = 300
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


def mass_matrix(n: int, skew: float, q: numpy.ndarray) -> numpy.ndarray:
    """H of the same chain, as the sum of J_kᵀ M_k J_k over its links."""
    cos, sin = numpy.cos(skew), numpy.sin(skew)
    turn = numpy.array([[1, 0, 0], [0, cos, -sin], [0, sin, cos]])
    inertia = numpy.diag([0.0025, 1.015 / 12, 1.015 / 12])
    axes, origins = numpy.zeros((n, 3)), numpy.zeros((n, 3))
    H, frame, origin = numpy.zeros((n, n)), numpy.eye(3), numpy.zeros(3)
    for k in range(n):
        if k:
            frame, origin = frame @ turn, origin + frame[:, 0]
        axes[k], origins[k] = frame[:, 2], origin
        c, s = numpy.cos(q[k]), numpy.sin(q[k])
        frame = frame @ numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        J_w = axes[: k + 1]
        J_v = numpy.cross(J_w, origin + 0.5 * frame[:, 0] - origins[: k + 1])
        H[: k + 1, : k + 1] += J_v @ J_v.T + J_w @ (frame @ inertia @ frame.T) @ J_w.T
    return H


def main() -> None:
    for path in sorted(Path(sys.argv[1]).glob("swing-*.f64")):
        name = path.stem.removeprefix("swing-")
        skew, n = float(name.rsplit("-", 1)[0]), int(name.rsplit("-", 1)[1])
        rows = numpy.fromfile(path).reshape(-1, n)
        if n <= LARGEST:
            model = chain(n, skew)
            data = model.createData()

            def form(q: numpy.ndarray) -> numpy.ndarray:
                pinocchio.crba(model, data, q)
                return data.M
        else:
            H = mass_matrix(n, skew, rows[-1])

            def form(q: numpy.ndarray) -> numpy.ndarray:
                return H

        times, begin = [], time.perf_counter()
        for q in rows[:ROWS]:
            start = time.perf_counter()
            numpy.linalg.eigvalsh(form(q), UPLO="U")
            times.append(time.perf_counter() - start)
            if time.perf_counter() - begin > SECONDS:
                break
        print(f"pinocchio {name}\t{numpy.median(times):e}")
        values = numpy.linalg.eigvalsh(form(rows[-1]), UPLO="U")
        least, most = map(float, path.with_suffix(".ends").read_text().split())
        # LAPACK knows λmin to about n ε λmax.
        print(f"error track {name}\t{max(abs(values[0] - least), abs(values[-1] - most)) / most:e}")


if __name__ == "__main__":
    main()
