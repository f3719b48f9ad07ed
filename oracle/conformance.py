"""eigenbody against Pinocchio: the mass matrix entry by entry, and its condition number.

    python oracle/conformance.py path/to/eigenbody
"""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cases import BASES, CONFIGURATIONS, ROBOTS, Robot
from command import CommandError, ask
from reference import Reference, condition_number

H_TOLERANCE = 1e-12  # of the largest entry
KAPPA_TOLERANCE = 1e-9  # of kappa

COLUMNS = "{:<14} {:<9} {:>3} {:>14} {:>15} {:>9}  {}"


@dataclass
class Worst:
    """The largest differences over the configurations of one robot and base."""

    nv: int = 0
    configurations: int = 0
    H: float = 0.0
    kappa: float = 0.0
    error: str = ""

    def passed(self) -> bool:
        # Written so that a NaN fails.
        return not self.error and self.H <= H_TOLERANCE and self.kappa <= KAPPA_TOLERANCE


def compare(command: Path, robot: Robot, base: str) -> Worst:
    worst = Worst()
    try:
        path = robot.path()
        reference = Reference(path, base)
        for configuration in CONFIGURATIONS:
            answer = ask(command, "matrix", path, base, configuration)
            kappa = ask(command, "spectrum", path, base, configuration)["kappa"]
            H, H_reference = np.array(answer["rows"]), reference.mass_matrix(answer["dofs"], answer["q"])
            if H.shape != H_reference.shape or kappa is None:
                raise ValueError(f"{configuration}: rows of shape {H.shape}, kappa {kappa}")
            kappa_reference = condition_number(H_reference)
            worst.nv = len(H)
            worst.configurations += 1
            # Not max(): it would lose a NaN.
            worst.H = np.maximum(worst.H, np.abs(H - H_reference).max() / np.abs(H_reference).max())
            worst.kappa = np.maximum(worst.kappa, abs(kappa - kappa_reference) / kappa_reference)
    except (CommandError, FileNotFoundError, KeyError, TypeError, ValueError) as error:
        worst.error = f"{type(error).__name__}: {error}"
    return worst


def main() -> int:
    if len(sys.argv) != 2:
        print("usage: conformance.py path/to/eigenbody", file=sys.stderr)
        return 2
    command = Path(sys.argv[1])
    verdicts = []
    print(COLUMNS.format("robot", "base", "nv", "configurations", "|dH| / max|H|", "dk / k", "verdict"))
    for robot in ROBOTS:
        for base in BASES:
            worst = compare(command, robot, base)
            verdicts.append(worst.passed())
            verdict = "passed" if verdicts[-1] else "FAILED"
            figures = f"{worst.H:.1e}", f"{worst.kappa:.1e}"
            print(COLUMNS.format(robot.name, base, worst.nv, worst.configurations, *figures, verdict), flush=True)
            if worst.error:
                print(f"  {worst.error}", flush=True)
    passed = sum(verdicts)
    print(f"at most {H_TOLERANCE:.0e} of max|H| and {KAPPA_TOLERANCE:.0e} of kappa allowed")
    print(f"{passed} passed, {len(verdicts) - passed} failed")
    return 0 if passed == len(verdicts) else 1


if __name__ == "__main__":
    sys.exit(main())
