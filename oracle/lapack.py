"""LAPACK's eigenvalues-only, by numpy, of the matrices that `peers matrices` wrote: one line a number.

The caller limits the threads: OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1.
"""

import sys
import time
from pathlib import Path

import numpy

# Of hydra(1000, 1, 0, 1) at zag(0).
EXACT = {"min": 0.021146039167710279588, "max": 81052547734.423965589}


def main() -> None:
    directory = Path(sys.argv[1])
    for n in [1000, 2000]:
        H = numpy.fromfile(directory / f"{n}.f64").reshape(n, n)
        start = time.perf_counter()
        values = numpy.linalg.eigvalsh(H)
        print(f"lapack {n}\t{time.perf_counter() - start:e}")
        if n == 1000:
            for name, found in [("min", values[0]), ("max", values[-1])]:
                print(f"error {name} lapack\t{abs(found / EXACT[name] - 1):e}")


if __name__ == "__main__":
    main()
