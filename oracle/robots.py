"""Every robot file of some packages: H entry by entry against the engine that the format comes from.

    python oracle/robots.py path/to/matrices

URDF against Pinocchio: on a floating base with mimic joints free, and on a fixed base with mimic joints followed where
Pinocchio can. MJCF against MuJoCo. Ten random configurations each, quaternions and free joints included.
"""

import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import generated
import packages
from engine import Engine, Refused
from mjcf_reference import MjcfReference
from urdf_reference import UrdfReference

TOLERANCE = 1e-10  # of the largest entry
CONFIGURATIONS = 10

COLUMNS = "{:<20} {:>6} {:>9} {:>7} {:>6} {:>8} {:>14}"


@dataclass
class Tally:
    """What became of the files of a package."""

    name: str
    files: int = 0
    reference: int = 0  # files that the reference engine loads
    loaded: int = 0
    equal: int = 0
    flagged: int = 0  # loaded with at least one finding
    worst: float = 0.0
    failures: list[str] = field(default_factory=list)

    def row(self) -> str:
        counts = self.files, self.reference, self.loaded, self.equal, self.flagged
        return COLUMNS.format(self.name, *counts, f"{self.worst:.1e}")

    def failed(self) -> bool:
        return bool(self.failures) or not self.equal == self.loaded == self.reference > 0


def difference(answer: dict, reference) -> float:
    """The largest difference over all configurations, against the largest entry."""
    n, worst = len(answer["dofs"]), 0.0
    for q, H in zip(answer["q"], answer["H"], strict=True):
        expected, found = reference(q), np.array(H).reshape(n, n)
        if n:
            # Not max(): it would lose a NaN.
            scale = np.abs(expected).max() or 1.0  # nothing has mass
            worst = np.maximum(worst, np.abs(found - expected).max() / scale)
    return worst


def compare(tally: Tally, name: str, ask, references) -> None:
    """Adds one file; `references` gives for each answer what H must be at a q."""
    tally.reference += 1
    try:
        worst, flagged = 0.0, False
        for options, expected in references:
            answer = ask(**options)
            flagged |= bool(answer["findings"])
            worst = np.maximum(worst, difference(answer, expected(answer)))
    except Refused as error:
        tally.failures.append(f"{name}: refused: {error}")
        return
    except ValueError as error:
        tally.loaded += 1
        tally.failures.append(f"{name}: {error}")
        return
    tally.loaded += 1
    tally.flagged += flagged
    tally.worst = np.maximum(tally.worst, worst)
    if worst <= TOLERANCE:
        tally.equal += 1
    else:
        tally.failures.append(f"{name}: H differs by {worst:.1e} of its largest entry")


def urdf(engine: Engine, package: str) -> Tally:
    tally = Tally(package)
    for path in packages.files(package, ".urdf"):
        tally.files += 1
        references = []
        try:
            free = UrdfReference(path, "floating", mimic=False)
        except ValueError:
            continue
        references.append(({"base": "floating"}, free))
        try:
            references.append(({"mimic": True}, UrdfReference(path, "fixed", mimic=True)))
        except ValueError:
            pass  # Pinocchio wants a joint before those that follow it

        def ask(**options):
            return engine.ask(path, configurations=CONFIGURATIONS, **options)

        def at(reference):
            return lambda answer: lambda q: reference.mass_matrix(answer["dofs"], answer["joints"], q)

        compare(tally, packages.short(path, package), ask, [(o, at(r)) for o, r in references])
    return tally


def mjcf(engine: Engine, name: str, paths, short) -> Tally:
    tally = Tally(name)
    for path in paths:
        tally.files += 1
        try:
            reference = MjcfReference(path)
        except ValueError:
            continue  # MuJoCo itself does not compile it

        def expected(answer):
            reference.check(answer["joints"])
            return reference.mass_matrix

        def ask():
            return engine.ask(path, configurations=CONFIGURATIONS)

        compare(tally, short(path), ask, [({}, expected)])
    return tally


def main() -> int:
    if len(sys.argv) != 2:
        print("usage: robots.py path/to/matrices", file=sys.stderr)
        return 2
    engine = Engine(Path(sys.argv[1]))
    start = time.perf_counter()
    print(COLUMNS.format("package", "files", "reference", "loaded", "equal", "flagged", "|dH| / max|H|"))
    tallies = []

    def done(tally: Tally) -> None:
        tallies.append(tally)
        print(tally.row(), flush=True)
        for failure in tally.failures:
            print(f"  {failure}", flush=True)

    done(urdf(engine, "example-robot-data"))
    for package in ("dm-control", "robosuite", "gymnasium"):
        done(mjcf(engine, package, packages.mjcf(package), lambda path, p=package: packages.short(path, p)))
    with generated.files() as paths:
        done(mjcf(engine, "generated MJCF", paths, lambda path: path.name))
    failed = sum(tally.failed() for tally in tallies)
    print(f"at most {TOLERANCE:.0e} of max|H| allowed, {CONFIGURATIONS} configurations a file; {time.perf_counter() - start:.0f} s")
    print(f"{sum(t.equal for t in tallies)} passed, {sum(t.reference - t.equal for t in tallies)} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
