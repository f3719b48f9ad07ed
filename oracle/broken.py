"""Broken copies of the robot files of whole packages, read with at most 1 GB of memory.

    python oracle/broken.py path/to/mutations
"""

import resource
import subprocess
import sys

import packages

COPIES = 10_000
MEMORY = 1 << 30  # bytes of address space
LONGEST = 1 << 20  # bytes of a file


def main() -> int:
    if len(sys.argv) != 2:
        print("usage: broken.py path/to/mutations", file=sys.stderr)
        return 2
    paths = packages.files("example-robot-data", ".urdf") + packages.files("example-robot-data", ".sdf")
    for package in ("dm-control", "robosuite", "gymnasium"):
        paths += packages.mjcf(package)
    lines = "".join(f"{path}\n" for path in paths if path.stat().st_size <= LONGEST)

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

    result = subprocess.run([sys.argv[1], str(COPIES)], input=lines, text=True, preexec_fn=limit)
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"at most {MEMORY >> 20} MB of memory allowed, {peak:.0f} MB were used")
    return 0 if result.returncode == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
