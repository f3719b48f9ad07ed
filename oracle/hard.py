"""eigenbody against 300 digits where the mass matrix is singular or nearly so.

    python oracle/hard.py path/to/eigenbody

Both ends of the spectrum must lie within the error that eigenbody states, or the smaller one be called unresolved, below a bound
that holds.
"""

import math
import re
import sys
from pathlib import Path

from flint import arb, ctx

from cases import example
from command import ask
from spectrum import ends
from urdf import Robot

ctx.dps = 300
# iCub's neck: two of its axes meet at zero yaw, with links of next to no inertia between.
ICUB = example("icub", "icub_description/robots/icub.urdf")
YAWS = [0.5] + [10.0**-k for k in range(1, 10)] + [0.0]
# A wrist joint that moves no mass.
ROMEO = example("romeo", "romeo_description/urdf/romeo.urdf")

COLUMNS = "{:<8} {:<22} {:>22} {:>9} {:>9} {:>9} {:>9}  {}"


def configurations(robot: str, names: list[str]) -> list[tuple[str, list[float]]]:
    if robot == "romeo":
        return [("zero", [0.0] * len(names)), ("bent", [0.1 * (d % 7) for d in range(len(names))])]
    bent = [0.1 * (d % 5) for d in range(len(names))]
    yaw = names.index("neck_yaw")
    return [(f"neck_yaw {angle:g}", bent[:yaw] + [angle] + bent[yaw + 1 :]) for angle in YAWS]


def main() -> int:
    command = Path(sys.argv[1])
    failures = 0
    print(COLUMNS.format("robot", "configuration", "lambda_min", "error", "stated", "max error", "stated", "verdict"))
    for case in (ICUB, ROMEO):
        path = case.path()
        robot = Robot(path)
        names = ask(command, "matrix", path, "fixed", "zero")["dofs"]
        for label, q in configurations(case.name, names):
            answer = ask(command, "spectrum", path, "fixed", f"q={q}")
            order, H = robot.mass_matrix(dict(zip(names, q, strict=True)))
            if order != names:
                raise ValueError(f"joints in another order: {order} and {names}")
            passed, figures = judge(answer, H)
            failures += not passed
            print(COLUMNS.format(case.name, label, *figures, "passed" if passed else "FAILED"), flush=True)
    print(f"{failures} failed")
    return 1 if failures else 0


def judge(answer: dict, H: list[list[arb]]) -> tuple[bool, list[str]]:
    try:
        least, greatest = ends(H)
    except ArithmeticError:
        # A pivot of exactly zero: H is singular.
        least, greatest = arb(0), None
    figures, verdicts = [], []
    stated = answer["error_estimate"]
    if answer["lambda_min"] is None:
        bound = re.search(r"below ([0-9.e+-]+)", answer["note"] or "")
        below = float(bound[1].rstrip(".")) if bound else 0.0
        verdicts.append(bool(least <= below) or (below == 0.0 and bool(least < arb(10) ** -250)))
        figures += [least.str(8, radius=False), "-", f"< {below:.0e}"]
    else:
        error = float(abs(arb(answer["lambda_min"]) / least - 1).mid()) if least != 0 else math.inf
        verdicts.append(error <= stated["lambda_min"])
        figures += [least.str(8, radius=False), f"{error:.1e}", f"{stated['lambda_min']:.1e}"]
    if greatest is not None:
        error = float(abs(arb(answer["lambda_max"]) / greatest - 1).mid())
        verdicts.append(error <= stated["lambda_max"])
        figures += [f"{error:.1e}", f"{stated['lambda_max']:.1e}"]
    else:
        figures += ["-", "-"]
    return all(verdicts), figures


if __name__ == "__main__":
    sys.exit(main())
